// Renders a tick with nothing but the renderer and what it is made of, and names a fault of a device.
#include <cstdio>
#include <string>

#include <calligraphy/model/character_list.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

int main() {
  using namespace calligraphy;
  const std::string name = to_string(DeviceFault::unplugged);
  Capabilities device;
  device.peak_force = 3.3;
  device.usable_stiffness = 1000.0;
  HapticRenderer renderer({{*built_in_characters().find(U'一'), {{0.0, 0.0}, 0.04}}}, {}, device,
                          RendererOptions::for_device(device));
  const HapticTick& tick = renderer.update({});
  std::printf("%s, %g N\n", name.c_str(), tick.force.norm());
  return name == "unplugged" ? 0 : 1;
}
