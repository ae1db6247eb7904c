// Moves a simulated device with nothing but the devices.
#include <cstdio>

#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/devices/simulated_device.hpp>

int main() {
  calligraphy::SimulatedDevice device(calligraphy::device_profile("desktop"));
  const calligraphy::DeviceState state = device.read();
  std::printf("%s: %s\n", device.capabilities().model.c_str(), calligraphy::to_string(state.status));
  device.close();
  return state.status == calligraphy::DeviceStatus::ok ? 0 : 1;
}
