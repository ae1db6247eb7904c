#include <calligraphy/practice/live_session.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <thread>
#include <utility>

#include <calligraphy/practice/lesson.hpp>

#include "base/monotonic_clock.hpp"
#include "base/require.hpp"
#include "session_tick.hpp"

namespace calligraphy {
namespace {

/// Time between two updates of the display.
constexpr std::chrono::milliseconds update_interval(20);

/// Minimum timeout of the servo loop, which matters at low rates [ticks].
constexpr double min_timeout = 3.0;

/// Share of the page that is written or skipped [1].
double share_done(const PracticePage& page, const LessonView& lesson) {
  const auto due = static_cast<std::size_t>(lesson.due);
  if (due == lesson.strokes.size()) return 1.0;
  return share_written(page, lesson.strokes[due].character, lesson.strokes[due].stroke);
}

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
  LessonOptions lesson_options;
  lesson_options.renderer = options.renderer;
  lesson_options.feedback = options.mode;
  lesson_options.law = options.law;
  lesson_options.mapping = mapping;
  lesson_options.records_all = true;
  Lesson lesson({page}, with_peak_force(device.capabilities(), options.peak_force), lesson_options);
  const double rate = lesson.rate();
  ServoLoopOptions servo = options.servo;
  if (servo.servo.rate == 0.0) servo.servo.rate = rate;
  servo.servo.timeout = std::max(servo.servo.timeout, min_timeout / rate);
  std::atomic<bool> in_front = false;  // the way out of an inkwell, which lies behind the paper, is not writing
  std::atomic<double> behind = 0.0;
  ForceLaw loop_law = [&](const DeviceState& state) noexcept {
    if (!in_front.load(std::memory_order_relaxed)) {
      const double depth = -mapping.to_page(state.position).z();
      behind.store(std::max(depth, 0.0), std::memory_order_relaxed);
      if (!(depth < 0.0)) return Eigen::Vector3d(Eigen::Vector3d::Zero());
      in_front.store(true, std::memory_order_relaxed);
    }
    lesson.update(state);
    return Eigen::Vector3d(lesson.force());
  };
  loop_law.rate = rate;
  ServoLoop loop(device, std::move(loop_law), servo);

  LiveResult result;
  LiveView view;
  const auto take_over = [&] {
    view.lesson = lesson.look();
    view.events.clear();
    for (LessonEvent event; lesson.take_event(event);) view.events.push_back(event);
    view.progress = share_done(page, view.lesson);
    const Recording& recording = lesson.recording();
    if (!recording.samples.empty()) view.newest = recording.samples.back();
    if (options.keep) options.keep(recording);
  };
  const auto watch = [&] {
    view.advice = device.advice();
    return !options.watch || options.watch(view);
  };
  take_over();
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
    if (!watch() || view.lesson.has_failed) break;
    if (view.lesson.is_finished && !view.lesson.is_on_paper) break;
    if (!options.commands) continue;
    for (const LessonCommandKind command : options.commands()) lesson.send({command});
  }
  loop.stop();
  take_over();
  result.recording = lesson.recording();
  result.writing = lesson.writing();
  result.statistics = loop.statistics();
  result.dropped = view.lesson.lost_ticks;
  result.error = lesson.law_error();
  return result;
}

}  // namespace calligraphy
