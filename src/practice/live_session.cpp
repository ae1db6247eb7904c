#include <calligraphy/practice/live_session.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include <calligraphy/devices/sample_queue.hpp>

#include "base/monotonic_clock.hpp"
#include "base/require.hpp"
#include "session_tick.hpp"

namespace calligraphy {
namespace {

/// Time between two updates of the display.
constexpr std::chrono::milliseconds update_interval(20);

/// Time for which the calling thread can be away before ticks are lost [s].
constexpr double max_absence = 10.0;

/// Minimum timeout of the servo loop, which matters at low rates [ticks].
constexpr double min_timeout = 3.0;

/// One tick for the calling thread: what the recording keeps, and what only a display shows.
struct LiveTick {
  RecordedSample sample;
  DeviceState input;
  WritingHint hint = WritingHint::none;
  Point to_start = Point::Zero();
};

}  // namespace

Capabilities with_peak_force(Capabilities capabilities, double peak_force) {
  require(peak_force > 0.0, "peak_force", peak_force, "N", "above 0");
  capabilities.peak_force = std::min(capabilities.peak_force, peak_force);
  capabilities.continuous_force = std::min(capabilities.continuous_force, peak_force);
  return capabilities;
}

LiveResult write_with_device(const PracticePage& page, HapticDevice& device, const LiveOptions& options) {
  require_above_zero("timeout", options.timeout, "s");
  validate(device.capabilities());
  const MotionMapping mapping = options.mapping.value_or(upright_page(page.width, page.height));
  const Capabilities capabilities = with_peak_force(device.capabilities(), options.peak_force);
  HapticRenderer renderer(page.characters, mapping, capabilities, options.renderer);
  SessionTick session(renderer, capabilities, options.mode, options.law, true);
  const double rate = renderer.options().servo_rate;
  SampleQueue<LiveTick> queue(static_cast<std::size_t>(std::ceil(max_absence * rate)));
  ServoLoopOptions servo = options.servo;
  if (servo.servo.rate == 0.0) servo.servo.rate = rate;
  servo.servo.timeout = std::max(servo.servo.timeout, min_timeout / rate);
  std::atomic<bool> in_front = false;  // the way out of an inkwell, which lies behind the paper, is not writing
  std::atomic<double> behind = 0.0;
  std::atomic<bool> has_failed = false;
  ForceLaw loop_law = [&](const DeviceState& state) noexcept {
    if (!in_front.load(std::memory_order_relaxed)) {
      const double depth = -mapping.to_page(state.position).z();
      behind.store(std::max(depth, 0.0), std::memory_order_relaxed);
      if (!(depth < 0.0)) return Eigen::Vector3d(Eigen::Vector3d::Zero());
      in_front.store(true, std::memory_order_relaxed);
    }
    const HapticTick& tick = session.update(state);
    queue.push({session.sample(), session.input(state), tick.hint, tick.to_start});
    if (session.has_failed()) has_failed.store(true, std::memory_order_relaxed);
    return Eigen::Vector3d(session.force());
  };
  loop_law.rate = rate;
  ServoLoop loop(device, std::move(loop_law), servo);

  LiveResult result;
  result.recording = recording_for(page, renderer, options.renderer, capabilities, options.mode, options.law);
  LiveView view;
  LiveTick newest;
  const auto take_over = [&] {
    while (queue.pop(newest)) {
      result.recording.samples.push_back(newest.sample);
      result.recording.inputs.push_back(newest.input);
    }
    if (options.keep) options.keep(result.recording);
    view.newest = newest.sample;
    view.hint = newest.hint;
    view.to_start = newest.to_start;
  };
  const int count = static_cast<int>(page.characters.size());
  const auto watch = [&] {
    view.advice = device.advice();
    return !options.watch || options.watch(view);
  };
  if (options.keep) options.keep(result.recording);
  bool is_wanted = true;
  const double begin = monotonic_seconds();
  result.warnings = loop.start([&](const std::vector<std::string>& warnings) {
    view.warnings = warnings;
    is_wanted = watch();
  });
  while (is_wanted && monotonic_seconds() - begin < options.timeout) {
    std::this_thread::sleep_for(update_interval);
    take_over();
    view.servo = loop.status();
    view.started = in_front.load(std::memory_order_relaxed);
    view.behind = behind.load(std::memory_order_relaxed);
    view.progress = share_written(page, view.newest.character, view.newest.stroke);
    if (!watch() || has_failed.load(std::memory_order_relaxed)) break;
    if (view.newest.character >= count && view.newest.state != InteractionState::writing) break;
  }
  loop.stop();
  take_over();
  result.statistics = loop.statistics();
  result.dropped = queue.dropped();
  result.error = session.error();
  return result;
}

}  // namespace calligraphy
