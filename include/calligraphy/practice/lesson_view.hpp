// What whoever draws a lesson needs to know of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <calligraphy/practice/lesson_event.hpp>
#include <calligraphy/practice/lesson_options.hpp>

namespace calligraphy {

/// What became of a stroke of the page, or of the ink of a pen-down.
enum class StrokeFate : std::uint8_t {
  open,      ///< still to be written; ink: of a pen-down that goes on, or about which nothing is decided yet
  accepted,  ///< written
  skipped,   ///< passed over
  refused,   ///< ink: of a pen-down that did not write the stroke that was due
  ignored    ///< ink: of a pen-down that was no writing
};

/// "open", "accepted", "skipped", "refused", "ignored".
const char* to_string(StrokeFate fate) noexcept;

/// A stroke of the page.
struct LessonStroke {
  int character = 0;                    ///< index on the page of its character
  int stroke = 0;                       ///< index within it
  StrokeFate fate = StrokeFate::open;   ///< open, accepted or skipped
  int misses = 0;                       ///< pen-downs that were to write it, and did not
  int pen_down = -1;                    ///< number of the pen-down that wrote it; -1: none
  bool is_shown = false;                ///< whether its template is to be seen
};

/// The pupil's own hand, where it is known and differs from the pen, which guidance pulls; otherwise all is NaN.
struct LessonHand {
  Point place = Point::Constant(std::numeric_limits<double>::quiet_NaN());  ///< where it is [m, page]
  double time = std::numeric_limits<double>::quiet_NaN();  ///< by the pupil's clock, which never goes back [s]
  double pressure = std::numeric_limits<double>::quiet_NaN();  ///< StylusState::pressure, known or not [1]
};

/// Ink of one pen-down: samples of Lesson::recording().
struct LessonInk {
  int pen_down = 0;                     ///< its number, from 0
  std::size_t begin = 0;                ///< index of its first sample
  std::size_t end = 0;                  ///< index behind its last sample
  StrokeFate fate = StrokeFate::open;   ///< what became of it
  bool is_doubted = false;              ///< open, and the next pen-down decides: perhaps it was lifted too early
};

/// A stroke that the lesson writes.
struct LessonDemonstration {
  int stroke = -1;        ///< index into LessonView::strokes; -1: none
  double share = 0.0;     ///< of its length that is written now [1]
};

/// A lesson as it is. Everything follows from the last tick but one sixtieth of a second, whatever was missed before.
struct LessonView {
  LessonMode mode = LessonMode::guided;  ///< what is shown, and whether the pen is guided
  int page = 0;                          ///< index of the page
  std::uint64_t tick = 0;                ///< samples so far
  double time = 0.0;                     ///< of the last one [s]
  std::vector<LessonStroke> strokes;     ///< of the page, in order
  int due = 0;                           ///< index of the stroke that is due; their number once there is none
  int accepted = 0;                      ///< number of strokes that were written
  int skipped = 0;                       ///< number of strokes that were passed over
  int right_at_once = 0;                 ///< number of strokes that were accepted without a miss
  bool is_finished = false;              ///< nothing is due, and the pen was lifted
  bool is_paused = false;                ///< as LessonCommandKind::pause
  bool is_on_paper = false;              ///< the pen
  Point pen_tip = Point::Zero();         ///< of the pen, guided [m, page]
  Point hand = Point::Zero();            ///< where the pupil's own hand was last on the paper; NaN: not known [m, page]
  bool shows_start = false;              ///< the start of the stroke that is due is to be marked
  Point start = Point::Zero();           ///< where that stroke begins [m, page]
  Point direction = Point::Zero();       ///< unit vector in which it sets out; 0: a stroke without length
  WritingHint hint = WritingHint::none;  ///< the hint that was given last, until it is out of date
  RefusalReason reason = RefusalReason::none;  ///< why the last pen-down was refused, until that is out of date
  Point hint_place = Point::Zero();      ///< where the pen was then [m, page]
  LessonDemonstration demonstration;     ///< the stroke that the lesson writes
  double assistance = 1.0;               ///< HapticTick::assistance [1]
  bool has_failed = false;               ///< the law has thrown, or its force was not finite: Lesson::law_error()
  std::vector<LessonInk> ink;            ///< of this page, by pen-down
  std::uint64_t lost_ticks = 0;          ///< that are missing from the recording, and from ink, since look() came late
  std::uint64_t lost_events = 0;         ///< that did not fit into the queue
};

}  // namespace calligraphy
