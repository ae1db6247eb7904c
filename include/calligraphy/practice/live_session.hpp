// A person writing a page on a real device.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <calligraphy/devices/haptic_device.hpp>
#include <calligraphy/devices/servo_loop.hpp>
#include <calligraphy/practice/feedback_mode.hpp>
#include <calligraphy/practice/lesson_event.hpp>
#include <calligraphy/practice/lesson_score.hpp>
#include <calligraphy/practice/lesson_view.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/recording.hpp>
#include <calligraphy/render/motion_mapping.hpp>
#include <calligraphy/render/renderer_options.hpp>

namespace calligraphy {

/// What a display shows, updated about 50 times per second.
struct LiveView {
  RecordedSample newest;                 ///< the latest tick; all zero before the first one
  LessonView lesson;                     ///< the lesson as it is; its ink is of LiveResult::recording
  std::vector<LessonEvent> events;       ///< what has happened in it since the last call
  ServoStatus servo;                     ///< state of the loop and its fault, if any
  std::vector<std::string> warnings;     ///< as LiveResult::warnings; known before the first tick
  std::string advice;                    ///< what the user has to do about the device (HapticDevice::advice())
  double progress = 0.0;                 ///< share of the page written or skipped so far, in [0, 1]
  bool started = false;  ///< the pen has been in front of the paper; until then no force is sent and nothing recorded
  double behind = 0.0;   ///< how far the pen is behind the paper, until `started` [m, page]
};

/// Options of a person writing on a device.
struct LiveOptions {
  FeedbackMode mode = FeedbackMode::force;  ///< whether the device receives the renderer's force
  RendererOptions renderer;                 ///< options of the renderer; the servo loop runs at its rate
  ForceLaw law = {};                        ///< as SessionOptions::law
  /// Device axes to page axes; by default upright_page() of the page. On a desk: desk_page().
  std::optional<MotionMapping> mapping = std::nullopt;
  ServoLoopOptions servo;                                       ///< options of the servo loop
  double peak_force = std::numeric_limits<double>::infinity();  ///< upper bound, besides the device's own [N]
  double timeout = 600.0;                                       ///< the session ends after this time [s]
  /// Called on the calling thread, for the first time before the first tick; false ends the session.
  std::function<bool(const LiveView&)> watch = nullptr;
  /// Called after each `watch` but the first: what the lesson is asked to do.
  std::function<std::vector<LessonCommandKind>()> commands = nullptr;
  /// As SessionOptions::keep, on the calling thread, about 50 times per second.
  std::function<void(const Recording&)> keep = nullptr;
};

/// Result of write_with_device().
struct LiveResult {
  Recording recording;                ///< from the moment the pen was first in front of the paper: Lesson::recording()
  LessonWriting writing;              ///< what was written in the end, and the attempts: score_lesson()
  ServoStatistics statistics;         ///< statistics of the servo loop since its start
  std::uint64_t dropped = 0;          ///< ticks missing from the recording because the calling thread was too late
  std::vector<std::string> warnings;  ///< what ServoLoop::start() returned
  std::exception_ptr error;           ///< what a law threw, or a ValueError for a non-finite force, ending the session
};

/// The capabilities with their forces limited to a peak [N], which may be infinite.
/// @throws ValueError unless the peak is above 0
Capabilities with_peak_force(Capabilities capabilities, double peak_force);

/// Holds a guided Lesson in the servo loop, on the device's own clock or on a thread of this library, while the calling
/// thread records. Starts when the pen is in front of the paper for the first time, because the inkwell of a device may
/// be behind it. Ends when every stroke is written or skipped and the pen lifted, `watch` returns false, or the timeout
/// expires. On return the force is zero and the device still open.
/// @throws ValueError when an option is out of its domain, DeviceError when the clock cannot be started
LiveResult write_with_device(const PracticePage& page, HapticDevice& device, const LiveOptions& options);

}  // namespace calligraphy
