// How a lesson is held.
#pragma once

#include <limits>
#include <optional>

#include <calligraphy/devices/servo.hpp>
#include <calligraphy/practice/feedback_mode.hpp>
#include <calligraphy/render/motion_mapping.hpp>
#include <calligraphy/render/renderer_options.hpp>

namespace calligraphy {

/// What a lesson shows of the characters, and whether it guides the pen.
enum class LessonMode {
  guided,       ///< shows all strokes, and guides
  vision,       ///< shows all strokes
  next_stroke,  ///< shows the stroke that is due, and guides
  memory,       ///< shows nothing before it was missed
  watch         ///< writes the strokes itself, one after the other: the pen does nothing and feels nothing
};

/// "guided", "vision", "next stroke", "memory", "watch".
const char* to_string(LessonMode mode) noexcept;

/// Whether a mode guides the pen.
constexpr bool is_guided(LessonMode mode) noexcept {
  return mode == LessonMode::guided || mode == LessonMode::next_stroke;
}

/// Options of a Lesson.
struct LessonOptions {
  LessonMode mode = LessonMode::guided;  ///< what is shown, and whether the pen is guided
  /// Share of the way to the stroke over which a hand with RendererOptions::grip_stiffness is pulled, from 0 to 0.95.
  /// NaN: as `renderer` says [1].
  double strength = std::numeric_limits<double>::quiet_NaN();
  /// Options of the renderer. With guidance.assist.enabled guidance fades with success and comes back with failure, and
  /// what it has faded to is kept from page to page.
  RendererOptions renderer;
  FeedbackMode feedback = FeedbackMode::force;  ///< whether the device receives the renderer's force
  ForceLaw law = {};                            ///< as SessionOptions::law
  /// Device axes to page axes; by default upright_page() of the first page.
  std::optional<MotionMapping> mapping = std::nullopt;
  int misses_until_shown = 2;  ///< a stroke that was missed so often is shown and written once; 0: never
  double hint_time = 0.25;     ///< time for which a hint must hold before it is given [s]
  bool records_all = false;    ///< record every tick and what came in, for replayed(), not only those on the paper
  /// Time on the paper, or with `records_all` any time, for which look() need not be called before the ticks that follow
  /// are lost to the recording, at most 60 [s].
  double max_absence = 10.0;
};

/// @throws ValueError naming the option that is out of its domain, but for those of the renderer
void validate(const LessonOptions& options);

}  // namespace calligraphy
