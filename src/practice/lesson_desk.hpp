// The half of a lesson that looks on: makes scenes, and collects what happens into a view and a recording.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <vector>

#include <calligraphy/practice/lesson_score.hpp>
#include <calligraphy/practice/lesson_view.hpp>
#include <calligraphy/practice/recording.hpp>

#include "lesson_machine.hpp"

namespace calligraphy {

/// A tick for the half that looks on, in few cache lines: not all of it to the last bit.
struct LessonSample {
  double time = 0.0;               ///< RecordedSample::time
  Point pen_tip = Point::Zero();   ///< RecordedSample::pen_tip, and its height [m, page]
  LessonHand hand;
  float height = 0.0F;
  Eigen::Vector3f device_point = Eigen::Vector3f::Zero();
  Eigen::Vector3f force = Eigen::Vector3f::Zero();
  int pen_down = -1;       ///< number of the one whose ink it is; -1: none
  std::uint32_t start = 0;  ///< LessonScene::start
  int character = 0;
  int stroke = 0;
  TickEvent events = TickEvent::none;
  InteractionState state = InteractionState::separation;
  TickStatus status = TickStatus::ok;
  bool can_be_made_again = true;  ///< as the ticks before: a renderer that gets the same samples does the same
};

/// The same tick, exactly.
struct RecordedTick {
  RecordedSample sample;
  DeviceState input;
};

class LessonDesk {
 public:
  /// @throws as Lesson
  LessonDesk(std::vector<PracticePage> pages, const Capabilities& device, const LessonOptions& options);

  /// A new scene on a page of these, from a tick on; what was written stays unless it `begins`. @throws as Lesson, and
  /// then changes nothing
  LessonScene& make(std::vector<PracticePage> pages, std::size_t index, const LessonOptions& options, bool begins,
                    std::uint64_t tick);

  const std::vector<PracticePage>& pages() const noexcept { return pages_; }
  std::size_t page_index() const noexcept { return index_; }
  const LessonOptions& options() const noexcept { return options_; }
  /// The scene that was made last, and the one that the loop was last seen in.
  LessonScene& newest() const noexcept { return *scenes_.back(); }
  const LessonScene& seen() const noexcept { return *scenes_.front(); }
  /// Ticks that wait for look() at most.
  std::size_t capacity() const;

  /// `exact`: the same, if every tick is recorded.
  void take(const LessonSample& sample, const RecordedTick* exact);
  void take(const LessonEvent& event);
  void take(const LessonState& state);
  bool take_event(LessonEvent& event) noexcept;

  /// Given how many ticks and events were lost on the way.
  const LessonView& view(std::uint64_t lost_ticks, std::uint64_t lost_events);
  const Recording& recording() const noexcept { return recording_; }
  const std::vector<LessonHand>& hands() const noexcept { return hands_; }
  /// As Lesson::writing().
  LessonWriting writing() const;

 private:
  void begin_recording(std::uint32_t start);
  void view_strokes();
  void view_ink();
  bool shows(int stroke) const;

  Capabilities device_;
  std::vector<PracticePage> pages_;
  std::size_t index_ = 0;
  LessonOptions options_;
  std::vector<std::unique_ptr<LessonScene>> scenes_;  ///< in use, or to be used, in order
  LessonState state_;
  LessonView view_;
  Recording recording_;
  std::uint32_t recorded_ = 0;  ///< LessonScene::start of the recording
  std::vector<LessonHand> hands_;  ///< of the samples of the recording
  std::deque<LessonEvent> events_;
  std::uint64_t lost_events_ = 0;  ///< that the caller did not take in time
  std::vector<LessonEvent> attempts_;  ///< what was refused, ignored or undone on this page
};

}  // namespace calligraphy
