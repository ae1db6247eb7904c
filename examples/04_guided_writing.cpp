// Guided writing on a device: the servo loop renders the forces at 1 kHz, a display follows the newest tick.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>
#include <vector>

#include <calligraphy/calligraphy.hpp>

namespace {

using namespace calligraphy;

/// The user: moves the pointer along the strokes, 2 mm beside them, one stroke a second.
class User {
 public:
  explicit User(const PlacedCharacter& placed) {
    for (const Stroke& stroke : strokes(placed.character)) strokes_.push_back(place_elements(stroke, placed.placement));
  }

  void move(PointerDevice& device, double time) const {
    const std::size_t stroke = static_cast<std::size_t>(time);
    if (stroke >= strokes_.size()) return device.move(0.0, 0.0, 0.0);
    const double share = time - static_cast<double>(stroke);  // lifted, to the start; down, along the stroke; lifted
    const bool pressed = share > 0.3 && share < 0.9;
    const Point place = strokes_[stroke].front().point(std::clamp((share - 0.4) / 0.45, 0.0, 1.0));
    device.move(place.x() + 0.002, place.y() - 0.002, pressed ? 0.5 : 0.0);
  }

  int stroke_count() const { return static_cast<int>(strokes_.size()); }

 private:
  std::vector<std::vector<StrokeElement>> strokes_;
};

}  // namespace

int main() {
  install_emergency_stop();  // no force is left behind when this program ends, however it ends
  const PracticePage page = lay_out({built_in_characters().at(U'十')}).front();
  const MotionMapping mapping = upright_page(page.width, page.height);

  // A simulated pen that is pulled to where the program moves the pointer: here as `User` does, in an application as
  // the mouse or tablet does. With a real device: OpenHapticsDevice device;
  PointerOptions pointer;
  pointer.paper.translation() = mapping.to_device(Eigen::Vector3d::Zero());
  PointerDevice device(device_profile("desktop"), {}, pointer);

  HapticRenderer renderer(page.characters, mapping, device.capabilities(),
                          RendererOptions::for_device(device.capabilities()));
  LatestValue<HapticTick> newest;  // from the servo thread to the display, neither of which waits for the other
  const auto law = [&](const DeviceState& state) noexcept {
    const HapticTick& tick = renderer.update(state);
    newest.publish(tick);
    return tick.force;
  };
  ServoLoop loop(device, law);  // at the rate of the device, as the renderer

  const User user(page.characters.front());
  for (const std::string& warning : loop.start()) std::printf("%s\n", warning.c_str());
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  HapticTick shown;
  for (int frame = 0; shown.character == 0 && elapsed() < user.stroke_count() + 1; ++frame) {
    user.move(device, elapsed());
    if (newest.take(shown) && frame % 6 == 0) {  // draw the pen at pen_tip, not at the pointer
      const int stroke = std::min(shown.stroke + 1, user.stroke_count());  // after the last one, until the lift: the count
      std::printf("%5.2f s  stroke %d  pen (%5.1f, %5.1f) mm  %-10s %.2f N\n", shown.time, stroke,
                  1e3 * shown.pen_tip.x(), 1e3 * shown.pen_tip.y(), to_string(shown.state), shown.force.norm());
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(16));  // 60 frames a second
  }
  loop.stop();  // ramps the force down to zero
  std::printf("%s\n", renderer.last().character == 1 ? "written" : "not finished");
}
