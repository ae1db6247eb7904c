// A lesson: what a teacher does while characters are written.
#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <vector>

#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/devices/device_state.hpp>
#include <calligraphy/practice/lesson_event.hpp>
#include <calligraphy/practice/lesson_options.hpp>
#include <calligraphy/practice/lesson_score.hpp>
#include <calligraphy/practice/lesson_view.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/recording.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

namespace calligraphy {

class LessonDesk;
struct LessonScene;

/// Follows a pupil through the strokes of a page: counts misses and gives their reasons, gives hints, shows strokes,
/// and keeps what was written.
///
/// It has two halves, for two threads or for one. The loop's half, from update() to has_commands(), takes every
/// decision, and neither allocates, locks, throws nor logs. The other half, all the rest, sends commands and looks on,
/// as often as it likes: that changes no decision (docs/lesson.md).
class Lesson {
 public:
  /// A lesson on the first of these pages.
  /// @throws ValueError when there is no page, or an option, the device or a page is invalid, as HapticRenderer
  Lesson(std::vector<PracticePage> pages, const Capabilities& device, const LessonOptions& options = {});
  ~Lesson();

  /// Processes one sample of the device: force() is then to be written to it. `hand`: the pupil's own, if it is known,
  /// as of a pointer; its pressure is that of the sample.
  const HapticTick& update(const DeviceState& sample, const LessonHand* hand = nullptr) noexcept;
  /// Device axes [N]. Zero while the lesson is paused or writes the strokes itself (LessonMode::watch), once the force
  /// has been ramped down as for a device that is silent.
  const Eigen::Vector3d& force() const noexcept;
  /// Says that what the pen-down that is going on has done, and will do, is no writing: LessonCommandKind::ignore.
  void ignore() noexcept;
  /// Whether what the pen does is seen: not while the lesson is paused or writes the strokes itself.
  bool sees_pen() const noexcept;
  /// Whether something is undecided or is being shown, so that the passing of time alone may change the lesson.
  bool is_waiting() const noexcept;
  /// Whether something was asked for that has not been carried out yet.
  bool has_commands() const noexcept;
  /// What the law threw first, or a ValueError that names it; null unless LessonView::has_failed. Not while another
  /// thread calls update().
  std::exception_ptr law_error() const;

  /// Asks for something. Returns false, and does nothing, if 64 commands wait already.
  bool send(const LessonCommand& command) noexcept;
  /// Begins the page again once the pen is off the paper, from a tick on.
  void again(std::uint64_t tick = 0);
  /// Begins the next of the pages, after the last the first.
  void next(std::uint64_t tick = 0);
  /// Begins the first of other pages, which should be as large as the first ones: the mapping stays. @throws as the
  /// constructor; then nothing changes
  void begin(std::vector<PracticePage> pages, std::uint64_t tick = 0);
  /// Changes options, but for `mapping`, `records_all` and `max_absence`. Another mode begins the page again; otherwise
  /// what was written stays, and the change takes effect once the pen is off the paper and nothing is in doubt.
  /// @throws as the constructor; then nothing changes
  void change(const LessonOptions& options, std::uint64_t tick = 0);

  /// The page that the other half has seen begin last.
  const PracticePage& page() const noexcept;
  /// The options given last.
  const LessonOptions& options() const noexcept;

  /// Ticks per second [Hz].
  double rate() const noexcept;

  /// Takes over what has happened, and returns how things are.
  const LessonView& look();
  /// Takes the next event; false if there is none. At most 1,024 wait.
  bool take_event(LessonEvent& event) noexcept;
  /// Of this page, up to the last look(): every tick, or those on the paper. One of every tick loses its set-up once
  /// the ticks cannot be made again from what came in: after a skip, an undo, a pause or an ignore while the pen is
  /// down, a change of options, and, where guidance fades, a refusal.
  const Recording& recording() const noexcept;
  /// The pupil's own hand at each of its samples.
  const std::vector<LessonHand>& hands() const noexcept;
  /// What is to be judged of this page, up to the last look(): score_lesson(), in this thread or another.
  LessonWriting writing() const;

 private:
  struct Loop;

  void post(LessonScene& scene);

  std::unique_ptr<LessonDesk> desk_;
  std::unique_ptr<Loop> loop_;
};

}  // namespace calligraphy
