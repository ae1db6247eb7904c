#include "lesson_desk.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <calligraphy/base/error.hpp>

namespace calligraphy {
namespace {

constexpr std::size_t max_kept_events = 1024;  // for a caller who takes none
constexpr double shortest_lift = 0.052;        // that no score takes for a bounce [s]

}  // namespace

LessonDesk::LessonDesk(std::vector<PracticePage> pages, const Capabilities& device, const LessonOptions& options)
    : device_(device) {
  LessonOptions chosen = options;
  if (!chosen.mapping && !pages.empty()) chosen.mapping = upright_page(pages.front().width, pages.front().height);
  make(std::move(pages), 0, chosen, true, 0);
  begin_recording(newest().start);
}

LessonScene& LessonDesk::make(std::vector<PracticePage> pages, std::size_t index, const LessonOptions& options,
                              bool begins, std::uint64_t tick) {
  validate(options);
  if (pages.empty()) throw ValueError("a lesson needs a page");
  for (const PracticePage& page : pages) {
    if (page.characters.empty()) throw ValueError("a page of a lesson has no character");
  }
  auto scene = std::make_unique<LessonScene>(pages[index], device_, options);
  scene->page_index = static_cast<int>(index);
  scene->tick = tick;
  if (!scenes_.empty()) {
    const LessonScene& last = newest();
    scene->number = last.number + 1;
    scene->start = begins ? scene->number : last.start;
    if (!begins) {
      scene->progress = last.progress;
      scene->tick = std::max(tick, last.tick);  // should the page not have begun yet
    }
  }
  scenes_.push_back(std::move(scene));
  pages_ = std::move(pages);
  index_ = index;
  options_ = options;
  return newest();
}

std::size_t LessonDesk::capacity() const {
  const double ticks = options_.max_absence * newest().renderer.options().servo_rate;
  return static_cast<std::size_t>(std::ceil(std::max(ticks, 1.0)));
}

void LessonDesk::begin_recording(std::uint32_t start) {
  const auto has_begun = [&](const auto& scene) { return scene->start == start; };
  const auto scene = std::find_if(scenes_.begin(), scenes_.end(), has_begun);
  const LessonScene& begun = **scene;
  recording_ = recording_for(begun.page, begun.renderer, begun.wanted, device_, begun.options.feedback,
                             begun.options.law);
  recorded_ = start;
  hands_.clear();
  view_.ink.clear();
}

void LessonDesk::take(const LessonSample& sample, const RecordedTick* exact) {
  if (sample.start < recorded_) return;
  if (sample.start > recorded_) begin_recording(sample.start);
  const std::size_t index = recording_.samples.size();
  hands_.push_back(sample.hand);
  if (exact) {
    recording_.samples.push_back(exact->sample);
    recording_.inputs.push_back(exact->input);
    if (!sample.can_be_made_again) recording_.setup.reset();
  } else {
    RecordedSample& made = recording_.samples.emplace_back();
    made.time = sample.time;
    made.device_point = sample.device_point.cast<double>();
    made.pen_tip << sample.pen_tip, static_cast<double>(sample.height);
    made.force = sample.force.cast<double>();
    made.state = sample.state;
    made.events = sample.events;
    made.status = sample.status;
    made.character = sample.character;
    made.stroke = sample.stroke;
  }
  if (sample.pen_down < 0) return;
  std::vector<LessonInk>& ink = view_.ink;
  const bool continues = !ink.empty() && ink.back().pen_down == sample.pen_down && ink.back().end == index;
  if (!continues) ink.push_back({.pen_down = sample.pen_down, .begin = index, .end = index});
  ink.back().end = index + 1;
}

void LessonDesk::take(const LessonEvent& event) {
  if (events_.size() == max_kept_events) {
    events_.pop_front();
    ++lost_events_;
  }
  events_.push_back(event);
  switch (event.kind) {
    case LessonEventKind::restarted:
      attempts_.clear();
      return;
    case LessonEventKind::refused:
    case LessonEventKind::ignored:
    case LessonEventKind::undone:
      attempts_.push_back(event);
      return;
    default:
      return;
  }
}

bool LessonDesk::take_event(LessonEvent& event) noexcept {
  if (events_.empty()) return false;
  event = events_.front();
  events_.pop_front();
  return true;
}

void LessonDesk::take(const LessonState& state) {
  state_ = state;
  const auto is_current = [&](const auto& scene) { return scene->number == state.scene; };
  scenes_.erase(scenes_.begin(), std::find_if(scenes_.begin(), scenes_.end(), is_current));
  if (seen().start > recorded_) begin_recording(seen().start);
}

const LessonView& LessonDesk::view(std::uint64_t lost_ticks, std::uint64_t lost_events) {
  const LessonScene& scene = seen();
  view_.mode = scene.options.mode;
  view_.page = scene.page_index;
  view_.tick = state_.tick;
  view_.time = state_.time;
  view_.due = state_.due;
  view_.is_finished = state_.is_finished;
  view_.is_paused = state_.is_paused;
  view_.is_on_paper = state_.is_on_paper;
  view_.pen_tip = state_.pen_tip;
  view_.hand = state_.hand;
  view_.hint = state_.hint;
  view_.reason = state_.reason;
  view_.hint_place = state_.hint_place;
  view_.assistance = state_.assistance;
  view_.has_failed = state_.has_failed;
  view_.lost_ticks = lost_ticks;
  view_.lost_events = lost_events_ + lost_events;
  view_strokes();
  view_ink();
  return view_;
}

void LessonDesk::view_strokes() {
  const LessonScene& scene = seen();
  const std::size_t count = scene.strokes.size();
  view_.strokes.resize(count);
  view_.accepted = view_.skipped = view_.right_at_once = 0;
  for (std::size_t i = 0; i < count; ++i) {
    LessonStroke& stroke = view_.strokes[i];
    const LessonProgress::OfStroke& progress = scene.progress->strokes[i];
    const int written_by = progress.written_by.load(std::memory_order_relaxed);
    stroke.character = scene.strokes[i].character;
    stroke.stroke = scene.strokes[i].stroke;
    stroke.pen_down = std::max(written_by, -1);
    stroke.fate = written_by >= 0                              ? StrokeFate::accepted
                  : written_by == LessonProgress::is_skipped ? StrokeFate::skipped
                                                               : StrokeFate::open;
    stroke.misses = progress.misses.load(std::memory_order_relaxed);
    stroke.is_shown = shows(static_cast<int>(i));
    view_.accepted += stroke.fate == StrokeFate::accepted;
    view_.skipped += stroke.fate == StrokeFate::skipped;
    view_.right_at_once += stroke.fate == StrokeFate::accepted && stroke.misses == 0;
  }
  const bool is_due = state_.due < static_cast<int>(count);
  const bool marks_start = view_.mode != LessonMode::memory && view_.mode != LessonMode::watch;
  view_.shows_start = marks_start && is_due && (state_.pen_down < 0 || state_.is_stroke_done);
  if (is_due) {
    view_.start = scene.strokes[static_cast<std::size_t>(state_.due)].start;
    view_.direction = scene.strokes[static_cast<std::size_t>(state_.due)].direction;
  }
  view_.demonstration = {};
  if (state_.demonstrated < 0) return;
  const double time = demonstration_time(scene.strokes[static_cast<std::size_t>(state_.demonstrated)]);
  const double share = std::clamp((state_.time - state_.demonstrated_since) / time, 0.0, 1.0);
  view_.demonstration = {state_.demonstrated, share};
}

LessonWriting LessonDesk::writing() const {
  LessonWriting writing;
  writing.page = seen().page;
  writing.strokes = view_.strokes;
  for (const LessonEvent& attempt : attempts_) {
    if (attempt.kind == LessonEventKind::refused) writing.attempts.push_back(attempt);
  }
  Recording& recording = writing.recording;
  recording.rate = recording_.rate;
  recording.page = recording_.page;
  recording.law = recording_.law;
  double added = 0.0;  // to the times
  int pen_down = -1;
  const auto is_known = [](const LessonHand& hand) { return hand.place.allFinite(); };
  const bool has_hand = std::all_of(hands_.begin(), hands_.end(), is_known);
  for (std::size_t i = 0; i < writing.strokes.size(); ++i) {
    const LessonStroke& stroke = writing.strokes[i];
    if (stroke.fate != StrokeFate::accepted) continue;
    const std::size_t before = recording.samples.size();
    for (const LessonInk& ink : view_.ink) {
      if (ink.pen_down != stroke.pen_down || ink.pen_down == pen_down) continue;
      for (std::size_t k = ink.begin; k < ink.end; ++k) {
        recording.samples.push_back(recording_.samples[k]);
        RecordedSample& sample = recording.samples.back();
        sample.events = TickEvent::none;
        if (!has_hand) continue;
        writing.hands.push_back(hands_[k].place);
        if (std::isfinite(hands_[k].time)) sample.time = hands_[k].time;
      }
    }
    const bool has_ink = stroke.pen_down == pen_down || recording.samples.size() > before;
    if (!has_ink) {  // it was lost
      writing.strokes[i].pen_down = -1;
      continue;
    }
    if (before > 0 && before < recording.samples.size()) {
      const double last = recording.samples[before - 1].time, first = recording.samples[before].time;
      added = std::max(added, last + shortest_lift - first);
    }
    for (std::size_t k = before; k < recording.samples.size(); ++k) {  // a clock may have gone back
      double& time = recording.samples[k].time;
      time = std::max(time + added, k > 0 ? recording.samples[k - 1].time : time + added);
    }
    pen_down = stroke.pen_down;
    RecordedSample lift = recording.samples.back();
    lift.state = InteractionState::separation;
    lift.events = TickEvent::stroke_finished;
    const bool is_last = i + 1 == writing.strokes.size() || writing.strokes[i + 1].character != stroke.character;
    if (is_last) lift.events |= TickEvent::character_finished;
    if (i + 1 == writing.strokes.size()) lift.events |= TickEvent::page_finished;
    lift.character = stroke.character + (is_last ? 1 : 0);
    lift.stroke = is_last ? 0 : stroke.stroke + 1;
    recording.samples.push_back(lift);
    if (has_hand) writing.hands.push_back(writing.hands.back());
  }
  return writing;
}

/// Whether the template of a stroke is to be seen.
bool LessonDesk::shows(int stroke) const {
  const bool is_due = stroke == state_.due;
  if (state_.is_finished || (is_due && state_.is_stroke_shown)) return true;
  return view_.mode == LessonMode::next_stroke ? is_due : view_.mode != LessonMode::memory;
}

void LessonDesk::view_ink() {
  for (LessonInk& ink : view_.ink) {
    const bool is_undecided = ink.pen_down == state_.undecided;
    const auto is_own = [&](const auto& each) { return each.pen_down == ink.pen_down; };
    const bool is_accepted = std::any_of(view_.strokes.begin(), view_.strokes.end(), is_own);
    const auto last = std::find_if(attempts_.rbegin(), attempts_.rend(), is_own);
    ink.is_doubted = is_undecided && state_.is_doubted;
    if (is_accepted) {
      ink.fate = StrokeFate::accepted;
    } else if (is_undecided || ink.pen_down == state_.pen_down || ink.pen_down >= state_.pen_downs) {
      ink.fate = StrokeFate::open;
    } else {
      const bool is_refused = last == attempts_.rend() || last->kind == LessonEventKind::refused;
      ink.fate = is_refused ? StrokeFate::refused : StrokeFate::ignored;
    }
  }
}

}  // namespace calligraphy
