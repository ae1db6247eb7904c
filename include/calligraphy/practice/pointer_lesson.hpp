// A lesson for a mouse, a finger or the pen of a tablet, in the time of its events.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <utility>
#include <vector>

#include <calligraphy/base/stylus_state.hpp>
#include <calligraphy/devices/pointer_device.hpp>
#include <calligraphy/practice/lesson.hpp>

namespace calligraphy {

/// Kind of a pointer, as in Pointer Events.
enum class PointerKind : std::uint8_t { mouse, touch, pen };

/// What a pointer does at a time.
struct PointerSample {
  double time = 0.0;                      ///< of any clock that does not go back [s]
  Point place = Point::Zero();            ///< on the page [m]
  bool is_down = false;                   ///< whether it writes
  bool is_cancelled = false;              ///< the system has taken it: what it did since it was put down is no writing
  PointerKind kind = PointerKind::mouse;  ///< what it is
  std::int64_t id = 0;                    ///< tells fingers from each other
  std::uint32_t buttons = 0;              ///< one bit per button, or 0
  StylusState stylus = {};                ///< what a pen senses besides
};

/// Moves the light and well damped hand of a simulated device after a pointer, at 1 kHz of its own, and holds a lesson
/// with it: whoever draws it calls advance() before each picture. What it decides depends on the samples alone, not on
/// when advance() is called.
///
/// A touch that comes within 1.5 s of a pen is the palm that holds it, and one that is down when a pen comes was; a
/// pointer that is put down within 0.15 em of where it has just been lifted writes on; one that was not seen coming,
/// such as a finger, finds the pen there.
class PointerLesson {
 public:
  /// Of the options, `mapping` is that of the pages, and grip_stiffness and guidance.fade_in are those of this hand;
  /// the options of the renderer should be for `device`.
  /// @throws ValueError as Lesson
  PointerLesson(std::vector<PracticePage> pages, const Capabilities& device,
                const LessonOptions& options = {});

  /// Keeps a sample until its time has come. Those whose place or time is not finite are left out.
  void move(const PointerSample& sample);
  /// Goes on to a time, sample by sample. A rest of more than 1 s in which no pointer writes and nothing is in doubt
  /// passes at once, and of a pen that rests on the paper for longer, the last 60 s count.
  void advance(double time);
  /// Whether time matters: the pen writes, something is in doubt or is shown, or samples wait. Otherwise advance() need
  /// not be called.
  bool is_busy() const noexcept;
  /// As Lesson::change(), of this hand.
  void change(const LessonOptions& options);

  /// The lesson that it holds: for commands, views and events.
  Lesson& lesson() noexcept { return lesson_; }
  /// As above.
  const Lesson& lesson() const noexcept { return lesson_; }
  /// What the last tick returned; all zero before the first one.
  const HapticTick& last() const noexcept { return tick_; }

 private:
  PointerLesson(const LessonOptions& options, std::vector<PracticePage> pages, const Capabilities& device);

  bool takes(const PointerSample& sample);
  void take(const PointerSample& sample);
  void put(const PointerSample& sample, bool is_down);
  void bring(const PointerSample& sample);
  void tick(double time);
  Point hand_at(double time);
  bool is_at_rest() const noexcept;
  bool is_on_paper() const noexcept { return tick_.state != InteractionState::separation; }

  PointerDevice device_;
  Lesson lesson_;
  HapticTick tick_;
  std::deque<PointerSample> samples_;  ///< that wait, the next one first
  double time_ = -std::numeric_limits<double>::infinity();         ///< of the last tick [s]
  double last_sample_ = -std::numeric_limits<double>::infinity();  ///< that was taken [s]
  double pen_time_ = -std::numeric_limits<double>::infinity();     ///< when a pen was last seen [s]
  bool is_down_ = false;      ///< a pointer
  PointerSample pointer_;     ///< its last sample, or that of the one that hovers
  bool is_ignored_ = false;   ///< it was no writing
  std::deque<std::pair<double, Point>> places_;  ///< of the pointer, by time [s], that the hand has not passed yet
  double hand_time_;                             ///< by the clock of the samples [s]
};

}  // namespace calligraphy
