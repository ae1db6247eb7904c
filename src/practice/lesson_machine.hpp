// The decisions of a lesson, tick by tick (docs/lesson.md).
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include <calligraphy/devices/sample_queue.hpp>
#include <calligraphy/practice/lesson_event.hpp>
#include <calligraphy/practice/lesson_options.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

#include "session_tick.hpp"

namespace calligraphy {

/// A stroke of a page, as far as decisions depend on it.
struct StrokeOnPage {
  int character, stroke;
  Point start, end;  ///< [m, page]
  Point direction;   ///< in which it sets out
  double length;     ///< [m]
  double em;         ///< of its character [m]
};

/// What became of the strokes of a page. The loop writes it, and any thread may read it.
struct LessonProgress {
  static constexpr int is_open = -1, is_skipped = -2;

  struct OfStroke {
    std::atomic<int> written_by = is_open;  ///< number of the pen-down, or one of the above
    std::atomic<int> misses = 0;
  };

  explicit LessonProgress(std::size_t count) : strokes(count) {}

  std::vector<OfStroke> strokes;
};

/// A page, how it is held, and the renderer that follows the pen on it. The other half makes it, and the loop's half
/// goes over to it at a tick.
struct LessonScene {
  /// @throws as Lesson
  LessonScene(const PracticePage& page, const Capabilities& device, const LessonOptions& options);

  std::uint32_t number = 0;  ///< the later one's is larger
  std::uint32_t start = 0;   ///< of scenes in which what was written stays, the same
  std::uint64_t tick = 0;    ///< number of the sample before which it does not begin
  int page_index = 0;
  PracticePage page;
  LessonOptions options;
  RendererOptions wanted;  ///< of the renderer, as given to it
  std::vector<StrokeOnPage> strokes;
  std::shared_ptr<LessonProgress> progress;
  HapticRenderer renderer;
  bool is_plain;  ///< the force is the renderer's, and no tick need be recorded exactly: there is no session
  SessionTick session;
};

/// Time for which a lesson writes a stroke, and then shows it whole [s].
double demonstration_time(const StrokeOnPage& stroke) noexcept;
inline constexpr double demonstration_rest = 0.2;

/// How a lesson is. Plain, so that a LatestValue can pass it to whoever looks on.
struct LessonState {
  std::uint32_t scene = 0;          ///< LessonScene::number
  std::uint64_t tick = 0;           ///< samples so far
  double time = 0.0;                ///< of the last one [s]
  int due = 0;                      ///< index of a stroke of the page; their number: none is
  bool is_finished = false;
  bool is_paused = false;
  bool is_on_paper = false;
  bool is_stroke_done = false;      ///< the pen-down that goes on has written its stroke
  bool is_stroke_shown = false;     ///< the stroke that is due, whatever the mode
  int pen_downs = 0;                ///< so far
  int pen_down = -1;                ///< number of the one that goes on; -1: none
  int undecided = -1;               ///< of the one that is over, about which nothing is decided yet; -1: none
  bool is_doubted = false;          ///< that was left to the next one
  WritingHint hint = WritingHint::none;
  RefusalReason reason = RefusalReason::none;
  Point hint_place = Point::Zero();
  int demonstrated = -1;            ///< index of the stroke that the lesson writes; -1: none
  double demonstrated_since = 0.0;  ///< [s]
  Point pen_tip = Point::Zero();
  Point hand = Point::Constant(std::numeric_limits<double>::quiet_NaN());
  double assistance = 1.0;
  bool has_failed = false;  ///< a law
};

/// Neither allocates, locks, throws nor logs.
class LessonMachine {
 public:
  LessonMachine(LessonScene& scene, SampleQueue<LessonEvent>& events) noexcept;

  /// Whether what the pen does is to be seen: otherwise the renderer is to be told that the device is silent.
  bool sees_pen() const noexcept { return !state_.is_paused && scene_->options.mode != LessonMode::watch; }
  /// After a pause: the pen is seen again, which must be off the paper.
  bool is_resume_asked() const noexcept { return is_resume_asked_; }
  void resume() noexcept {
    state_.is_paused = is_resume_asked_ = false;
    has_changed_ = true;
  }
  /// Whether it can go over to another scene now, with a pen that is off the paper.
  bool can_enter(const LessonScene& next) const noexcept;
  void enter(LessonScene& next) noexcept;
  void take(LessonCommandKind command) noexcept;
  /// The scene's renderer has processed a sample.
  void update(const HapticTick& tick) noexcept;

  LessonScene& scene() const noexcept { return *scene_; }
  const LessonState& state() const noexcept { return state_; }
  /// Whether the passing of time may change it: nothing happens any more to a stroke that the next pen-down decides.
  bool is_waiting() const noexcept;
  /// Whether the state has changed other than by the passing of time since the last call.
  bool take_change() noexcept;
  /// Where the pupil's own hand is on the paper [m, page].
  void set_hand(const Point& hand) noexcept { state_.hand = hand; }
  /// Number of the pen-down whose ink the pen leaves in this tick; -1: none.
  int ink() const noexcept { return ink_; }

 private:
  struct PenDown {
    int number = -1;
    bool has_begun = false;   ///< a stroke, and nothing is decided about it
    bool is_finished = false;
    bool is_broken = false;   ///< it had begun a stroke, and did not write it
    bool is_ignored = false;
    double begin = 0.0;       ///< [s]
    double length = 0.0;      ///< of its path [m]
    double covered = 0.0;     ///< HapticTick::covered, where it left the stroke [1]
    WritingHint hint = WritingHint::none;  ///< why it was not guided
    Point finish = Point::Zero();          ///< where it finished a stroke
    Point place = Point::Zero();           ///< where the pen is, or was lifted
  };

  void take_events(const HapticTick& tick) noexcept;
  void put_down(const HapticTick& tick) noexcept;
  void lift(const HapticTick& tick) noexcept;
  void accept(PenDown& pen_down) noexcept;
  void settle(const PenDown& pen_down) noexcept;
  void refuse(const PenDown& pen_down) noexcept;
  RefusalReason why_refused(const PenDown& pen_down) const noexcept;
  void forget_attempt() noexcept;
  void drop_undecided() noexcept;
  void skip() noexcept;
  void undo() noexcept;
  void show() noexcept;
  void go_on_showing() noexcept;
  void look_at_hint(const HapticTick& tick) noexcept;
  void clear_hint() noexcept;
  bool set_due(int stroke) noexcept;
  void go_to_next() noexcept;
  void finish() noexcept;
  void add(LessonEventKind kind, int stroke, int pen_down) noexcept;
  void add(LessonEventKind kind, int stroke, int pen_down, RefusalReason reason, const Point& place) noexcept;

  int count() const noexcept { return static_cast<int>(scene_->strokes.size()); }
  const StrokeOnPage& stroke(int index) const noexcept { return scene_->strokes[static_cast<std::size_t>(index)]; }
  LessonProgress::OfStroke& progress(int index) const noexcept {
    return scene_->progress->strokes[static_cast<std::size_t>(index)];
  }

  LessonScene* scene_;
  SampleQueue<LessonEvent>* events_;
  LessonState state_;
  int ink_ = -1;
  bool has_changed_ = true;
  bool is_resume_asked_ = false;
  PenDown current_;           ///< that goes on, if state_.pen_down says so
  PenDown undecided_;         ///< if state_.undecided says so
  double last_lift_ = -std::numeric_limits<double>::infinity();  ///< [s]
  int skip_asked_ = -1;       ///< index of the stroke to be skipped as soon as it is not being written; -1: none
  bool undo_asked_ = false;
  WritingHint hint_ = WritingHint::none;  ///< of the last tick
  double hint_since_ = 0.0;               ///< [s]
  bool is_hint_given_ = false;
};

}  // namespace calligraphy
