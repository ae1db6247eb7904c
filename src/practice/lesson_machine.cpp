#include "lesson_machine.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <calligraphy/collision/stroke_element.hpp>

#include "pen_down.hpp"

namespace calligraphy {
namespace {

/// Ink farther from where its stroke was finished is no part of it [em].
constexpr double longest_tail = 0.12;

/// A pen-down that comes within max_bounce of a lift, is so short, and begins no stroke is a bounce [em].
constexpr double bounce_length = 0.05;

/// A stroke that was begun is whole if it was left this near to its end, or after so much of its length, and the pen
/// was along it if it covered that share of its own way [em, 1].
constexpr double near_end = 0.2, long_enough = 0.8;

/// Within this time the last stroke of a page is decided, and the hint about another one is given [s].
constexpr double longest_doubt = 1.2;

/// Steps of which the length of a pen-down is made up [em].
constexpr double length_step = 0.01;

/// Demonstration: before the pen moves, and for each em [s].
constexpr double demonstration_begin = 0.25, demonstration_of_em = 0.4;

constexpr TickEvent verdicts = TickEvent::stroke_finished | TickEvent::stroke_abandoned;

RefusalReason reason_of(WritingHint hint) noexcept {
  switch (hint) {
    case WritingHint::too_far:
      return RefusalReason::too_far;
    case WritingHint::at_end:
      return RefusalReason::at_end;
    case WritingHint::in_middle:
      return RefusalReason::in_middle;
    case WritingHint::wrong_direction:
      return RefusalReason::wrong_direction;
    case WritingHint::another_stroke:
      return RefusalReason::another_stroke;
    default:
      return RefusalReason::too_short;
  }
}

/// With the strength of guidance that a lesson is to have.
RendererOptions with_strength(const LessonOptions& options) {
  RendererOptions result = options.renderer;
  if (std::isnan(options.strength) && is_guided(options.mode)) return result;
  const double share = is_guided(options.mode) ? options.strength : 0.0;
  const double weaker = std::min(1.0, 2.0 * share);  // dampers and the spring against writing backwards
  result.guidance.stiffness = result.grip_stiffness * share / (1.0 - share);
  result.guidance.damping *= weaker;
  result.guidance.wrong_way_stiffness *= weaker;
  result.guidance.to_start = result.guidance.to_start && share > 0.0;
  if (share == 0.0) result.guidance.force = {};  // no law leads the pen
  return result;
}

std::vector<StrokeOnPage> strokes_on(const PracticePage& page) {
  std::vector<StrokeOnPage> result;
  for (std::size_t i = 0; i < page.characters.size(); ++i) {
    const auto& [character, placement] = page.characters[i];
    int index = 0;
    for (const Stroke& stroke : strokes(character)) {
      const std::vector<StrokeElement> elements = place_elements(stroke, placement);
      double length = 0.0;
      for (const StrokeElement& element : elements) length += element.length();
      result.push_back({static_cast<int>(i), index++, elements.front().point(0.0), elements.back().point(1.0),
                        elements.front().tangent(0.0), length, placement.em});
    }
  }
  return result;
}

}  // namespace

double demonstration_time(const StrokeOnPage& stroke) noexcept {
  return demonstration_begin + demonstration_of_em * stroke.length / stroke.em;
}

LessonScene::LessonScene(const PracticePage& on, const Capabilities& held, const LessonOptions& given)
    : page(on),
      options(given),
      wanted(with_strength(given)),
      strokes(strokes_on(on)),
      progress(std::make_shared<LessonProgress>(strokes.size())),
      renderer(on.characters, given.mapping.value_or(upright_page(on.width, on.height)), held, wanted),
      is_plain(given.feedback == FeedbackMode::force && !given.law && !given.records_all),
      session(renderer, held, given.feedback, given.law, given.records_all) {}

LessonMachine::LessonMachine(LessonScene& scene, SampleQueue<LessonEvent>& events) noexcept
    : scene_(&scene), events_(&events) {
  state_.scene = scene.number;
  add(LessonEventKind::restarted, 0, -1);
  if (scene.options.mode == LessonMode::watch) state_.demonstrated = 0;
}

/// What was written is not disturbed.
bool LessonMachine::can_enter(const LessonScene& next) const noexcept {
  return next.start != scene_->start || state_.undecided < 0;
}

void LessonMachine::enter(LessonScene& next) noexcept {
  has_changed_ = true;
  const bool goes_on = next.start == scene_->start;
  state_.pen_down = -1;  // of a pen that was not seen
  state_.is_on_paper = false;
  next.renderer.set_assistance(state_.assistance);
  scene_ = &next;
  state_.scene = next.number;
  hint_ = WritingHint::none;
  clear_hint();
  if (goes_on) {
    set_due(state_.due);
    return;
  }
  state_.due = 0;
  state_.undecided = -1;
  state_.is_doubted = state_.is_finished = state_.is_stroke_shown = false;
  skip_asked_ = -1;
  undo_asked_ = false;
  state_.demonstrated = next.options.mode == LessonMode::watch ? 0 : -1;
  state_.demonstrated_since = state_.time;
  add(LessonEventKind::restarted, 0, -1);
}

bool LessonMachine::is_waiting() const noexcept {
  if (state_.is_paused) return false;
  return state_.demonstrated >= 0 || (state_.undecided >= 0 && state_.time - last_lift_ < longest_doubt);
}

bool LessonMachine::take_change() noexcept { return std::exchange(has_changed_, false); }

void LessonMachine::take(LessonCommandKind command) noexcept {
  has_changed_ = true;
  const bool is_watched = scene_->options.mode == LessonMode::watch;
  switch (command) {
    case LessonCommandKind::skip:
      if (is_watched || state_.due == count()) return add(LessonEventKind::declined, state_.due, -1);
      skip_asked_ = state_.due;
      return skip();
    case LessonCommandKind::undo:
      if (is_watched) return add(LessonEventKind::declined, state_.due, -1);
      undo_asked_ = true;
      return undo();
    case LessonCommandKind::show:
      if (is_watched || state_.due == count()) return add(LessonEventKind::declined, state_.due, -1);
      return show();
    case LessonCommandKind::pause:
      state_.is_paused = true;
      is_resume_asked_ = false;
      if (state_.pen_down >= 0) current_.is_ignored = true;
      return;
    case LessonCommandKind::resume:
      is_resume_asked_ = state_.is_paused;
      return;
    case LessonCommandKind::ignore:
      if (state_.pen_down >= 0) current_.is_ignored = true;
      return;
  }
}

void LessonMachine::update(const HapticTick& tick) noexcept {
  state_.tick += 1;
  // It stands still in a pause, and a clock may go back.
  if (state_.is_paused || tick.time < state_.time) state_.demonstrated_since += tick.time - state_.time;
  state_.time = tick.time;
  state_.pen_tip = tick.pen_tip.head<2>();
  if (tick.status == TickStatus::bad_law || scene_->session.has_failed()) [[unlikely]] state_.has_failed = true;
  if (tick.events != TickEvent::none) [[unlikely]] take_events(tick);
  if (skip_asked_ >= 0) [[unlikely]] skip();
  if (undo_asked_) [[unlikely]] undo();
  if (state_.demonstrated >= 0) [[unlikely]] go_on_showing();
  if (tick.hint != WritingHint::none || hint_ != WritingHint::none) look_at_hint(tick);
  ink_ = -1;
  if (state_.pen_down < 0 || state_.is_finished) return;
  const double em = scene_->strokes.front().em, step = length_step * em;
  const double square = (state_.pen_tip - current_.place).squaredNorm();
  if (square > step * step) {
    current_.length += std::sqrt(square);
    current_.place = state_.pen_tip;
  }
  const double tail = longest_tail * em;
  const bool is_stray = current_.is_finished && (state_.pen_tip - current_.finish).squaredNorm() > tail * tail;
  if (!is_stray) ink_ = current_.number;
}

[[gnu::noinline]] void LessonMachine::take_events(const HapticTick& tick) noexcept {
  has_changed_ = true;
  state_.assistance = tick.assistance;
  if (has_event(tick.events, TickEvent::contact)) put_down(tick);
  const bool is_late = state_.undecided >= 0 && has_event(tick.events, verdicts);
  PenDown& judged = is_late ? undecided_ : current_;
  if (has_event(tick.events, TickEvent::stroke_finished)) {
    judged.finish = state_.pen_tip;
    if (judged.is_ignored) {
      judged.has_begun = false;
      forget_attempt();
    } else {
      accept(judged);
    }
  } else if (has_event(tick.events, TickEvent::stroke_abandoned)) {
    judged.is_broken = true;
    judged.has_begun = false;
    if (!is_late) judged.covered = tick.covered;
  }
  if (is_late) {
    state_.undecided = -1;
    state_.is_doubted = false;
    settle(undecided_);
  }
  if (has_event(tick.events, TickEvent::stroke_started)) {
    current_.has_begun = true;
    current_.is_finished = false;
    add(LessonEventKind::begun, state_.due, current_.number);
  }
  if (has_event(tick.events, TickEvent::lift)) lift(tick);
}

void LessonMachine::put_down(const HapticTick& tick) noexcept {
  current_ = {};
  current_.number = state_.pen_down = state_.pen_downs++;
  current_.begin = tick.time;
  current_.place = state_.pen_tip;
  state_.is_on_paper = true;
  state_.is_stroke_done = false;
  state_.demonstrated = -1;
  clear_hint();
}

void LessonMachine::lift(const HapticTick& tick) noexcept {
  current_.place = state_.pen_tip;
  current_.covered = tick.covered;
  state_.is_on_paper = false;
  state_.pen_down = -1;
  const bool wrote_nothing = !current_.has_begun && !current_.is_finished && !current_.is_broken;
  const bool bounced = current_.begin - last_lift_ <= max_bounce &&
                       current_.length <= bounce_length * scene_->strokes.front().em;
  last_lift_ = tick.time;
  if (wrote_nothing && bounced) current_.is_ignored = true;
  if (current_.is_ignored && !current_.is_finished) {
    if (current_.has_begun) forget_attempt();
    add(LessonEventKind::ignored, state_.due, current_.number);
  } else if (current_.has_begun) {
    undecided_ = current_;
    state_.undecided = undecided_.number;
  } else {
    settle(current_);
  }
}

/// The renderer does not wait for what becomes of it any more.
void LessonMachine::forget_attempt() noexcept {
  const StrokeOnPage& due = stroke(state_.due);
  scene_->renderer.set_due(due.character, due.stroke);
}

void LessonMachine::accept(PenDown& pen_down) noexcept {
  pen_down.is_finished = true;
  pen_down.has_begun = false;
  if (pen_down.number == state_.pen_down) state_.is_stroke_done = true;
  progress(state_.due).written_by.store(pen_down.number, std::memory_order_relaxed);
  add(LessonEventKind::accepted, state_.due, pen_down.number);
  go_to_next();
}

/// The stroke after the one that was due is due.
void LessonMachine::go_to_next() noexcept {
  state_.due += 1;
  state_.is_stroke_shown = false;
  state_.demonstrated = -1;
  skip_asked_ = -1;
  clear_hint();
}

/// What becomes of a pen-down that is over.
void LessonMachine::settle(const PenDown& pen_down) noexcept {
  if (!pen_down.is_finished && state_.due < count()) refuse(pen_down);
  if (state_.due == count() && state_.undecided < 0 && !state_.is_finished) finish();
}

void LessonMachine::refuse(const PenDown& pen_down) noexcept {
  if (skip_asked_ == state_.due) return add(LessonEventKind::ignored, state_.due, pen_down.number);
  const int misses = progress(state_.due).misses.fetch_add(1, std::memory_order_relaxed) + 1;
  const RefusalReason reason = why_refused(pen_down);
  if (state_.pen_down < 0) {  // otherwise the stroke is being written again
    clear_hint();
    state_.reason = reason;
    state_.hint_place = pen_down.place;
  }
  add(LessonEventKind::refused, state_.due, pen_down.number, reason, pen_down.place);
  const AssistPolicy& assist = scene_->options.renderer.guidance.assist;
  if (assist.enabled && !pen_down.is_broken) {  // of a stroke that was broken off the renderer knows itself
    state_.assistance = assist.next(state_.assistance, assist.full_assistance_error);
    scene_->renderer.set_assistance(state_.assistance);
  }
  const int most = scene_->options.misses_until_shown;
  if (most > 0 && misses >= most) show();
}

RefusalReason LessonMachine::why_refused(const PenDown& pen_down) const noexcept {
  const StrokeOnPage& due = stroke(state_.due);
  const double to_start = (pen_down.place - due.start).norm(), to_end = (pen_down.place - due.end).norm();
  if (pen_down.is_broken) {
    const bool is_along = pen_down.covered > long_enough * std::min(1.0, pen_down.length / due.length);
    const bool is_whole = to_end < near_end * due.em || pen_down.length > long_enough * due.length;
    return is_whole && !is_along ? RefusalReason::not_along : RefusalReason::lifted_early;
  }
  if (pen_down.hint == WritingHint::at_end && to_start < to_end) return RefusalReason::backwards;
  return reason_of(pen_down.hint);
}

void LessonMachine::skip() noexcept {
  if (state_.due != skip_asked_ || !set_due(state_.due + 1)) return;
  if (state_.pen_down >= 0) current_.is_ignored = true;
  drop_undecided();
  progress(state_.due).written_by.store(LessonProgress::is_skipped, std::memory_order_relaxed);
  add(LessonEventKind::skipped, state_.due, -1);
  go_to_next();
  if (state_.due == count() && state_.pen_down < 0) finish();
}

/// What was left in doubt is no writing.
void LessonMachine::drop_undecided() noexcept {
  if (state_.undecided >= 0) add(LessonEventKind::ignored, state_.due, state_.undecided);
  state_.undecided = -1;
  state_.is_doubted = false;
}

void LessonMachine::undo() noexcept {
  if (state_.undecided >= 0) {  // the last stroke is the one in doubt
    if (!set_due(state_.due)) return;
    undo_asked_ = false;
    clear_hint();
    return drop_undecided();
  }
  if (state_.due == 0) {
    undo_asked_ = false;
    return add(LessonEventKind::declined, 0, -1);
  }
  if (!set_due(state_.due - 1)) return;
  undo_asked_ = false;
  if (state_.pen_down >= 0) current_.is_ignored = true;
  state_.is_finished = state_.is_stroke_shown = false;
  state_.demonstrated = skip_asked_ = -1;
  clear_hint();
  state_.due -= 1;
  std::atomic<int>& written_by = progress(state_.due).written_by;
  const int undone = written_by.load(std::memory_order_relaxed);
  written_by.store(LessonProgress::is_open, std::memory_order_relaxed);
  add(LessonEventKind::undone, state_.due, std::max(undone, -1));
}

void LessonMachine::show() noexcept {
  state_.is_stroke_shown = true;
  if (state_.pen_down < 0) {
    state_.demonstrated = state_.due;
    state_.demonstrated_since = state_.time;
  }
  add(LessonEventKind::shown, state_.due, -1);
}

/// Ends a demonstration, or goes on to the next stroke if all are to be seen.
[[gnu::noinline]] void LessonMachine::go_on_showing() noexcept {
  const double time = state_.time - state_.demonstrated_since;
  if (time < demonstration_time(stroke(state_.demonstrated)) + demonstration_rest) return;
  has_changed_ = true;
  const bool goes_on = scene_->options.mode == LessonMode::watch;
  state_.demonstrated = goes_on && state_.demonstrated + 1 < count() ? state_.demonstrated + 1 : -1;
  state_.demonstrated_since = state_.time;
  if (goes_on && state_.demonstrated < 0) finish();
}

/// A hint is given once it has lasted: a moving pen passes many that it does not need to hear of.
[[gnu::noinline]] void LessonMachine::look_at_hint(const HapticTick& tick) noexcept {
  const WritingHint hint = tick.hint == WritingHint::write ? WritingHint::none : tick.hint;
  if (hint != hint_) {
    hint_ = hint;
    hint_since_ = tick.time;
    is_hint_given_ = false;
  }
  if (hint == WritingHint::none) return;
  const bool is_doubt = hint == WritingHint::lifted_early;
  if (is_doubt && state_.undecided >= 0 && !state_.is_doubted) state_.is_doubted = has_changed_ = true;
  const bool is_reason = current_.hint == WritingHint::none || hint == WritingHint::another_stroke;
  const bool is_of_pen_down = hint != WritingHint::lift_first && hint != WritingHint::warm_motors;
  if (state_.pen_down >= 0 && is_reason && is_of_pen_down) current_.hint = hint;
  if (is_hint_given_ || tick.time - hint_since_ < scene_->options.hint_time) return;
  is_hint_given_ = true;
  // Of a later one that was refused since, the reason is told.
  if (is_doubt && (state_.undecided < 0 || state_.undecided + 1 < state_.pen_downs)) return;
  has_changed_ = true;
  clear_hint();
  state_.hint = hint;
  state_.hint_place = state_.pen_tip;
  add(LessonEventKind::hinted, state_.due, state_.pen_down);
}

void LessonMachine::clear_hint() noexcept {
  state_.hint = WritingHint::none;
  state_.reason = RefusalReason::none;
}

/// Makes a stroke of the page due for the renderer.
bool LessonMachine::set_due(int index) noexcept {
  const int characters = static_cast<int>(scene_->page.characters.size());
  if (index == count()) return scene_->renderer.set_due(characters, 0);
  return scene_->renderer.set_due(stroke(index).character, stroke(index).stroke);
}

void LessonMachine::finish() noexcept {
  state_.is_finished = true;
  add(LessonEventKind::finished, count() - 1, -1);
}

void LessonMachine::add(LessonEventKind kind, int index, int pen_down) noexcept {
  add(kind, index, pen_down, RefusalReason::none, state_.pen_tip);
}

void LessonMachine::add(LessonEventKind kind, int index, int pen_down, RefusalReason reason,
                        const Point& place) noexcept {
  has_changed_ = true;
  const StrokeOnPage& concerned = stroke(std::min(index, count() - 1));
  LessonEvent event;
  event.tick = state_.tick > 0 ? state_.tick - 1 : 0;
  event.time = state_.time;
  event.kind = kind;
  event.reason = reason;
  event.hint = kind == LessonEventKind::hinted ? state_.hint : WritingHint::none;
  event.character = concerned.character;
  event.stroke = concerned.stroke;
  event.misses = progress(std::min(index, count() - 1)).misses.load(std::memory_order_relaxed);
  event.pen_down = pen_down;
  event.place = place;
  events_->push(event);
}

}  // namespace calligraphy
