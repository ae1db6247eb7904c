#include <calligraphy/practice/session.hpp>

#include <chrono>
#include <cmath>

#include <calligraphy/devices/flush_denormals.hpp>
#include <calligraphy/error.hpp>

namespace calligraphy {
namespace {

/// Where the pen waits before the first stroke, above the middle of the page [m].
constexpr double resting_height = 0.02;

/// Samples between two calls of the progress function.
constexpr std::size_t progress_interval = 256;

Intention to_device(const Intention& page, const MotionMapping& mapping) {
  return {mapping.to_device(page.position), mapping.rotation.transpose() * page.velocity / mapping.scale};
}

double share_written(const Page& page, const HapticTick& tick) {
  const auto count = static_cast<double>(page.characters.size());
  if (tick.character >= static_cast<int>(page.characters.size())) return 1.0;
  const auto& character = page.characters[static_cast<std::size_t>(tick.character)].character;
  return (tick.character + tick.stroke / static_cast<double>(character.stroke_count())) / count;
}

}  // namespace

Recording write_page(const Page& page, const SessionOptions& options) {
  if (!std::isfinite(options.longest_character) || options.longest_character <= 0.0) {
    throw ValueError("longest_character = " + std::to_string(options.longest_character) + " s");
  }
  const MotionMapping mapping = upright_page(page.width, page.height);
  HapticRenderer renderer(page.characters, mapping, options.device.capabilities, options.renderer);
  SimulatedWriter writer(page, options.skill, options.seed);
  SimulatedDevice device(options.device, options.skill.hand,
                         mapping.to_device({0.5 * page.width, 0.5 * page.height, resting_height}));

  const FlushDenormals as_a_servo_thread;
  using Clock = std::chrono::steady_clock;
  const double period = 1.0 / options.renderer.servo_rate;
  const double longest = options.longest_character * static_cast<double>(page.characters.size());
  Recording recording;
  recording.rate = options.renderer.servo_rate;
  while (!writer.done() && device.time() < longest) {
    const DeviceState state = device.read();
    const auto before = options.measure_ticks ? Clock::now() : Clock::time_point();
    const HapticTick& tick = renderer.update(state);
    const auto after = options.measure_ticks ? Clock::now() : Clock::time_point();

    const bool feels = options.mode == Mode::force;
    device.write(feels ? tick.force : Eigen::Vector3d(Eigen::Vector3d::Zero()));
    const Sight sight{tick.pen_tip, tick.character, tick.stroke, tick.state == InteractionState::writing};
    device.set_intention(to_device(writer.update(sight, period), mapping));
    device.advance(period);

    recording.samples.push_back({tick.time, tick.device_point, tick.pen_tip,
                                 feels ? tick.page_force : Eigen::Vector3d(Eigen::Vector3d::Zero()), tick.state,
                                 tick.events, tick.status, tick.character, tick.stroke,
                                 std::chrono::duration<float, std::nano>(after - before).count()});
    if (options.progress && recording.samples.size() % progress_interval == 0) {
      options.progress(share_written(page, tick));
    }
  }
  if (options.progress) options.progress(1.0);
  return recording;
}

}  // namespace calligraphy
