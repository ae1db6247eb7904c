#include "stroke_sequencer.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>

#include "collision/length.hpp"
#include "stroke_verdict.hpp"

namespace calligraphy {
namespace {

/// A pen leaves the box this far outside its edge [em]; while writing, this many times as far, since it is under force
/// there and would be thrown when the stroke is abandoned.
constexpr double box_hysteresis = 0.05, writing_hysteresis = 3.0;

/// A pen put down on the stroke this far along it is at its end.
constexpr double end_share = 0.75;

/// Guidance lets go of a pen where the tube's weight has fallen to this.
constexpr double min_held_weight = 0.5;

/// It also lets go where the hand means to be more than this many corridors across the stroke, beyond the offset that
/// is allowed for, and takes hold again within one.
constexpr double max_detour = 2.0;

/// A shorter stroke is a dot [em], and how long after its end it is looked at [s].
constexpr double longest_dot = 0.15, dot_time = 0.1;

/// Smaller motions may be a device's steps and noise [m, device].
constexpr double sensor_noise = 2e-4;

/// The next stroke is meant instead of the due one anew where the pen fits it better by this factor.
constexpr double surely_next = 1.5;

/// The last stroke of a page, if it is in doubt, was written once the pen has been in the air for this time [s].
constexpr double max_doubt = 1.0;

/// One in each millisecond; at a rate of 0, that of the device, which is not known yet, one a tick.
int fit_steps(double servo_rate) {
  return servo_rate > 0.0 ? static_cast<int>(std::ceil(std::min(1000.0 / servo_rate, 1000.0))) : 1;
}

bool is_within(const Eigen::AlignedBox2d& box, const Point& point) {
  return box.min().x() <= point.x() && point.x() <= box.max().x() && box.min().y() <= point.y() &&
         point.y() <= box.max().y();
}

}  // namespace

StrokeSequencer::StrokeSequencer(std::vector<PlacedCharacter> page, const RendererOptions& options,
                                 const Capabilities& capabilities, const MotionMapping& mapping, bool lets_go)
    : stroke_{options.nearest, options.guidance.space, options.rules},
      tolerances_(options.tolerances),
      box_hysteresis_(is_printed(options.rules) ? 0.0 : box_hysteresis),
      lift_between_strokes_(options.contact.lift_between_strokes),
      leads_to_start_(options.guidance.to_start),
      lets_go_(lets_go),
      fit_steps_(fit_steps(options.servo_rate)),
      mapping_(mapping),
      compliance_(mapping.scale * mapping.scale / options.grip_stiffness),
      page_(std::move(page), options) {
  const double dry_friction = capabilities.coulomb_friction + options.paper.friction.coefficient * usual_pressure;
  hidden_way_ = mapping.scale * dry_friction / options.grip_stiffness;
  hidden_motion_ = std::max(2.0 * hidden_way_, sensor_noise * mapping.scale);
  restart();
}

void StrokeSequencer::restart() noexcept {
  writer_ = {};
  inside_box_ = in_doubt_ = false;
  look_ = Look::none;
  attempt_.capture.restart();
  activate(0, 0);
}

bool StrokeSequencer::skip() noexcept {
  if (writer_.state == InteractionState::writing || all_written() || is_character_written()) return false;
  in_doubt_ = false;
  look_ = Look::none;
  const int next = writer_.stroke + 1;
  if (next < stroke_count()) {
    activate(writer_.character, next);
  } else if (writer_.state == InteractionState::separation) {
    activate(writer_.character + 1, 0);
  } else {
    writer_.stroke = next;
    writer_.rests = false;
  }
  // A pen on the paper was put down for the stroke that is no longer due: guidance lets go of it.
  if (writer_.state != InteractionState::separation) writer_.phase = WritingPhase::finished;
  return true;
}

bool StrokeSequencer::set_due(int character, int stroke) noexcept {
  const bool is_lifted = writer_.state == InteractionState::separation;
  if (writer_.state == InteractionState::writing || (character != writer_.character && !is_lifted)) return false;
  if (character < 0 || character > page_.size()) return false;
  const int count = character < page_.size() ? static_cast<int>(page_[character].strokes.size()) : 1;
  if (stroke < 0 || stroke >= count) return false;
  in_doubt_ = false;
  look_ = Look::none;
  activate(character, stroke);
  if (!is_lifted) writer_.phase = WritingPhase::finished;
  return true;
}

const WriterState& StrokeSequencer::update(const PenState& pen) noexcept {
  using State = InteractionState;
  const Point tip = pen.tip.head<2>();
  writer_.events = TickEvent::none;
  if (pen.status != TickStatus::ok) [[unlikely]] {
    if (look_ != Look::none) step_fit();  // samples may come less often than ticks
    return writer_;
  }
  if (look_ == Look::decides) [[unlikely]] decide(pen);
  if (in_doubt_) [[unlikely]] settle_doubt(pen);
  const TransitionInput input = advance(pen);
  const State before = writer_.state, after = next_state(before, input);
  writer_.state = after;
  if (before == State::separation && after != State::separation) [[unlikely]] writer_.events |= TickEvent::contact;
  if (before == State::writing && after != State::writing) [[unlikely]] {
    input.stroke_finished ? finish_stroke(tip) : leave_stroke(pen);
  }
  if (before != State::writing && after == State::writing) [[unlikely]] start_stroke(pen);
  if (before != State::separation && after == State::separation) [[unlikely]] lift();
  writer_.to_start = all_written() ? Point(Point::Zero()) : Point(due_->geometry.start() - tip);
  writer_.attraction = after == State::writing ? writer_.contact.attraction : due_->geometry.first_attraction();
  writer_.phase = phase(tip);
  writer_.guided = is_guided();
  return writer_;
}

TransitionInput StrokeSequencer::advance(const PenState& pen) noexcept {
  TransitionInput input;
  input.contact = pen.contact;
  if (all_written()) [[unlikely]] return input;

  const Point tip = pen.tip.head<2>();
  const bool writing = writer_.state == InteractionState::writing;
  const Eigen::AlignedBox2d& box = character_->box;
  if (is_within(box, tip)) [[likely]] {
    inside_box_ = true;
  } else if (inside_box_) [[unlikely]] {
    const double hysteresis = box_hysteresis_ * writer_.em * (writing ? writing_hysteresis : 1.0);
    inside_box_ = box.exteriorDistance(tip) <= hysteresis;
  }
  input.inside_box = inside_box_;
  input.may_start = writer_.phase != WritingPhase::finished && look_ != Look::decides;
  if (writing) {
    if (input.contact) write_on(pen);
    input.stroke_finished = is_finished(pen);
  } else if (input.contact && input.may_start) {
    if (writer_.state == InteractionState::separation) put_down(tip);
    input.begins = begins(pen);
  }
  return input;
}

[[gnu::noinline]] void StrokeSequencer::put_down(const Point& tip) noexcept {
  writer_.covered = 0.0;
  set_out(tip);
  if (tolerances_.coverage == 0.0) return;
  const StrokeContact nearest = due_->geometry.nearest(tip, stroke_);
  writer_.rests = nearest.closest.distance <= tolerances_.corridor * writer_.em;
  if (!writer_.rests) return;
  due_->geometry.rest(nearest);
  writer_.contact = nearest;
}

/// Another attempt, from where the pen is on the paper.
void StrokeSequencer::set_out(const Point& tip) noexcept {
  const auto put_down = [&](Attempt& attempt, int stroke) {
    attempt.capture.put_down(tip, character_->starts, static_cast<std::size_t>(stroke));
    begin_following(attempt, stroke);
  };
  if (next_in_doubt() >= 0) {
    next_.capture = attempt_.capture;
    put_down(next_, next_in_doubt());
  }
  put_down(attempt_, writer_.stroke);
}

bool StrokeSequencer::begins(const PenState& pen) noexcept {
  if (next_in_doubt() >= 0 && begins_next(pen)) return next_in_doubt() < 0;
  const CaptureVerdict verdict = try_to_begin(attempt_, writer_.stroke, pen);
  if (verdict == CaptureVerdict::begun) return true;
  if (verdict == CaptureVerdict::another_stroke) writer_.rests = false;
  if (writer_.rests) writer_.contact = due_->geometry.update(pen.tip.head<2>(), stroke_);
  return false;
}

CaptureVerdict StrokeSequencer::try_to_begin(Attempt& attempt, int stroke, const PenState& pen) noexcept {
  const Point from = attempt.capture.begin();
  const CaptureVerdict verdict = attempt.capture.update(pen.tip.head<2>(), character_->starts,
                                                        static_cast<std::size_t>(stroke), writer_.em, tolerances_);
  if (start(stroke).bends) {  // its ends do not say how it was written
    if (attempt.capture.begin() != from) begin_following(attempt, stroke);
    follow(attempt, stroke, pen);
  }
  return verdict;
}

/// Whether the pen seems to begin the next stroke rather than the due one anew, and once it has, finishes the due one.
[[gnu::noinline]] bool StrokeSequencer::begins_next(const PenState& pen) noexcept {
  const Point tip = pen.tip.head<2>();
  const int next = next_in_doubt();
  const auto misfit_to = [&](int stroke) {
    return next_.capture.misfit_to(start(stroke), tip, writer_.em, tolerances_);
  };
  const double of_rest = next_.capture.misfit_to(rest_, tip, writer_.em, tolerances_);
  const bool is_next = surely_next * misfit_to(next) < std::min(misfit_to(writer_.stroke), of_rest);
  const CaptureVerdict verdict = try_to_begin(next_, next, pen);
  if (!is_next) return false;
  if (verdict == CaptureVerdict::begun) confirm_stroke();
  return verdict != CaptureVerdict::another_stroke;
}

void StrokeSequencer::begin_following(Attempt& attempt, int stroke) noexcept {
  this->stroke(stroke).follower.begin(attempt.capture.begin(), attempt.capture.misplaced());
  attempt.path.begin(attempt.capture.begin(), writer_.em, hidden_motion_);
}

void StrokeSequencer::follow(Attempt& attempt, int stroke, const PenState& pen) noexcept {
  if (!pen.on_paper) return;
  const Point tip = pen.tip.head<2>(), hand = this->hand(pen);
  this->stroke(stroke).follower.update(tip, hand);
  attempt.path.update(tip);
}

void StrokeSequencer::write_on(const PenState& pen) noexcept {
  const Point tip = pen.tip.head<2>();
  // Made where it stays: a copy takes five more cache lines, of code and of data.
  static_assert(std::is_trivially_destructible_v<StrokeContact>);
  ::new (&writer_.contact) StrokeContact(due_->geometry.update(tip, stroke_));
  if (writer_.contact.passed_feature) writer_.events |= TickEvent::feature_passed;
  hand_ = hand(pen);
  if (pen.on_paper) {
    due_->follower.update(tip, hand_);
    attempt_.path.update(tip);
  }
  writer_.covered = due_->follower.covered();
}

/// At its end, once its shape is known. Nearly any small motion passes the end of a dot: that is looked at a little
/// later, or where the pen leaves it.
bool StrokeSequencer::is_finished(const PenState& pen) noexcept {
  if (tolerances_.coverage == 0.0) [[unlikely]] return writer_.contact.finished;
  if (!pen.on_paper) [[unlikely]] {
    look_for(Look::at_lift);
    return false;
  }
  if (look_ == Look::at_lift) look_ = Look::none;  // the pen was bouncing
  if (!due_->follower.is_at_end(hidden_way_) || !due_->follower.accepts(2.0 * hidden_way_)) [[likely]] return false;
  if (!passed_end_) passed_end_at_ = pen.time;
  passed_end_ = true;
  if (due_->shape.length < longest_dot && pen.time - passed_end_at_ < dot_time) return false;
  const bool is_known = look_ == Look::at_end && fit_.is_done();
  look_for(Look::at_end);
  return is_known && !is_vetoed(fit_.match(), due_->shape, tolerances_);
}

/// Once for each purpose, in the course of several ticks.
[[gnu::noinline]] void StrokeSequencer::look_for(Look purpose) noexcept {
  if (look_ != purpose) {
    look_ = purpose;
    fit_.begin(attempt_.path, due_->shape, attempt_.capture.misplaced());
  } else {
    step_fit();
  }
}

void StrokeSequencer::step_fit() noexcept {
  for (int i = 0; i < fit_steps_; ++i) fit_.step();
}

[[gnu::noinline]] void StrokeSequencer::start_stroke(const PenState& pen) noexcept {
  writer_.events |= TickEvent::stroke_started;
  if (in_doubt_) writer_.events |= TickEvent::stroke_abandoned;
  in_doubt_ = false;
  writer_.rests = passed_end_ = false;
  look_ = Look::none;
  due_->geometry.begin(attempt_.capture.begin());
  if (!start(writer_.stroke).bends) {
    begin_following(attempt_, writer_.stroke);
    attempt_.path.begin(attempt_.capture.own_begin(), writer_.em, hidden_motion_);
  }
  write_on(pen);
}

/// What was written is decided as soon as its shape is known.
[[gnu::noinline]] void StrokeSequencer::leave_stroke(const PenState& pen) noexcept {
  if (tolerances_.coverage == 0.0) {
    abandon_stroke(pen.tip.head<2>());
    return;
  }
  due_->follower.leave();
  writer_.covered = due_->follower.covered();
  if (look_ != Look::at_lift) look_for(Look::decides);
  look_ = Look::decides;
  if (fit_.is_done()) decide(pen);
}

/// A pen that comes back to the paper sooner finds it decided.
[[gnu::noinline]] void StrokeSequencer::decide(const PenState& pen) noexcept {
  const bool is_urgent = pen.contact && writer_.state == InteractionState::separation;
  while (is_urgent && !fit_.is_done()) fit_.step();
  if (!fit_.is_done()) {
    step_fit();
    return;
  }
  look_ = Look::none;
  const Point tip = pen.tip.head<2>();
  const double hidden = 2.0 * hidden_way_;
  const bool is_followed = passed_end_ || due_->follower.accepts(hidden);
  const StrokeVerdict verdict = is_followed && !is_vetoed(fit_.match(), due_->shape, tolerances_)
                                    ? StrokeVerdict::finished
                                    : verdict_on(fit_.match(), due_->shape, hidden / writer_.em, tolerances_);
  if (verdict == StrokeVerdict::finished) {
    finish_stroke(tip);
  } else if (verdict == StrokeVerdict::plausible) {
    in_doubt_ = true;
    lifted_at_ = pen.time;
    doubted_down_ = attempt_.capture.down();
    rest_.point = attempt_.path.points().back();
    rest_.direction = due_->geometry.at(due_->geometry.length()).tangent;
    due_->geometry.reload();
    if (writer_.state != InteractionState::separation) set_out(tip);
  } else {
    abandon_stroke(tip);
  }
}

[[gnu::noinline]] void StrokeSequencer::finish_stroke(const Point& tip) noexcept {
  writer_.events |= TickEvent::stroke_finished;
  attempt_.capture.written(due_->geometry.start(), attempt_.capture.down());
  const bool is_on_paper = writer_.state != InteractionState::separation;
  const bool must_lift = lift_between_strokes_ && is_on_paper;
  const int next = writer_.stroke + 1;
  if (next < stroke_count()) {
    activate(writer_.character, next);
  } else {
    writer_.events |= TickEvent::character_finished;
    if (writer_.character + 1 == page_.size()) writer_.events |= TickEvent::page_finished;
    // The box of the next character is elsewhere, and outside a box the paper does not press back: it would give way
    // under a pen that is still pressed on this character.
    if (must_lift) {
      writer_.stroke = next;
    } else {
      activate(writer_.character + 1, 0);
    }
  }
  if (must_lift) {
    writer_.phase = WritingPhase::finished;
  } else if (is_on_paper && !all_written()) {
    set_out(tip);
  }
}

[[gnu::noinline]] void StrokeSequencer::abandon_stroke(const Point& tip) noexcept {
  writer_.events |= TickEvent::stroke_abandoned;
  due_->geometry.reload();
  if (writer_.state != InteractionState::separation) set_out(tip);
}

/// The last stroke of a character, if in doubt, was written if the pen goes on with the next one, or nothing is left.
[[gnu::noinline]] void StrokeSequencer::settle_doubt(const PenState& pen) noexcept {
  if (next_in_doubt() >= 0) return;
  if (writer_.state != InteractionState::separation) {
    lifted_at_ = pen.time;
    return;
  }
  const int next = writer_.character + 1;
  const Point tip = pen.tip.head<2>();
  if (next == page_.size()) {
    if (pen.contact || pen.time - lifted_at_ < max_doubt) return;
  } else {
    const Point from_next = tip - page_[next].starts.front().point;
    const bool is_nearer = from_next.squaredNorm() < (tip - due_->geometry.start()).squaredNorm();
    if (!pen.contact || !is_nearer || !is_within(page_[next].box, tip)) return;
  }
  in_doubt_ = false;
  writer_.events |= TickEvent::stroke_finished | TickEvent::character_finished;
  if (next == page_.size()) writer_.events |= TickEvent::page_finished;
  activate(next, 0);
}

/// The pen has begun the next stroke: the due one was written.
[[gnu::noinline]] void StrokeSequencer::confirm_stroke() noexcept {
  in_doubt_ = false;
  writer_.events |= TickEvent::stroke_finished;
  next_.capture.written(due_->geometry.start(), doubted_down_);
  activate(writer_.character, writer_.stroke + 1);
  attempt_ = next_;
}

[[gnu::noinline]] void StrokeSequencer::lift() noexcept {
  writer_.events |= TickEvent::lift;
  writer_.rests = false;
  if (all_written()) return;
  if (is_character_written()) activate(writer_.character + 1, 0);
}

[[gnu::noinline]] void StrokeSequencer::activate(int character, int stroke) noexcept {
  if (character != writer_.character) {
    inside_box_ = false;
    attempt_.capture.restart();
  }
  writer_.character = character;
  writer_.stroke = stroke;
  writer_.rests = false;
  character_ = character < page_.size() ? &page_[character] : nullptr;
  if (all_written()) return;
  due_ = &this->stroke(stroke);
  writer_.geometry = &due_->geometry;
  writer_.em = character_->em;
  writer_.direction = start(stroke).direction;
}

/// Refines the paper's state as docs/capture.md draws it.
WritingPhase StrokeSequencer::phase(const Point& tip) const noexcept {
  if (writer_.state == InteractionState::separation) return in_doubt_ ? WritingPhase::in_doubt : WritingPhase::lifted;
  if (all_written()) return WritingPhase::page_written;
  if (writer_.state == InteractionState::writing) {
    return keeps_hold() ? WritingPhase::guided : WritingPhase::released;
  }
  return writer_.phase == WritingPhase::finished ? WritingPhase::finished : phase_before_stroke(tip);
}

WritingPhase StrokeSequencer::phase_before_stroke(const Point& tip) const noexcept {
  if (look_ == Look::decides) return WritingPhase::away;
  const auto phase_at_start = [](CaptureVerdict of) {
    return of == CaptureVerdict::wrong_direction ? WritingPhase::turned_away : WritingPhase::at_start;
  };
  const double near = tolerances_.start_distance * writer_.em;
  if (next_in_doubt() >= 0) {
    const double from_next = (tip - start(next_in_doubt()).point).norm();
    if (from_next <= near && from_next < writer_.to_start.norm()) return phase_at_start(next_.capture.verdict());
  }
  const CaptureVerdict verdict = attempt_.capture.verdict();
  if (verdict == CaptureVerdict::another_stroke) return WritingPhase::other_stroke;
  // The first stretch leads away from the start.
  const Point begun = attempt_.capture.begin() - due_->geometry.start();
  const double from_start = std::min(writer_.to_start.norm(), begun.norm());
  const bool is_late = writer_.rests && writer_.contact.arc > end_share * due_->geometry.length();
  if (is_late && (tip - due_->geometry.end()).norm() < from_start) return WritingPhase::at_end;
  if (from_start <= near) return phase_at_start(verdict);
  return writer_.rests ? WritingPhase::in_middle : WritingPhase::away;
}

/// Where the hand means to be, as shown by the force at work if the device reports it.
Point StrokeSequencer::hand(const PenState& pen) const noexcept {
  Point place = pen.tip.head<2>();
  if (is_finite(pen.force)) place -= mapping_.force_to_page(pen.force).head<2>() * compliance_;
  return place;
}

/// Guidance gradually lets go of a pen that is far from the stroke or that the hand pulls elsewhere, and takes hold
/// again when both are back: a pen that slipped out of the tube would be thrown, and one meant for another stroke would
/// be dragged along.
bool StrokeSequencer::keeps_hold() const noexcept {
  if (!lets_go_ || has_event(writer_.events, TickEvent::stroke_started)) return true;
  const StrokeContact& contact = writer_.contact;
  const double detour = due_->follower.astray(hand_, contact);
  const double corridor = tolerances_.corridor * writer_.em;
  if (writer_.guided) return contact.weight >= min_held_weight && detour <= max_detour * corridor;
  return contact.closest.distance <= corridor && detour <= corridor;
}

/// Before the stroke, guidance leads a pen that is likely to begin it: put down nearer to its start than to that of any
/// later stroke. A pen that rests elsewhere on the stroke is free forwards and resisted backwards, towards the start.
bool StrokeSequencer::is_guided() const noexcept {
  if (writer_.phase == WritingPhase::guided) return true;
  if (writer_.state != InteractionState::calibration || look_ == Look::decides) return false;
  switch (writer_.phase) {
    case WritingPhase::page_written:
    case WritingPhase::finished:
    case WritingPhase::other_stroke:
      return false;
    case WritingPhase::at_start:
      return attempt_.capture.is_nearest();
    default:
      return leads_to_start_ && attempt_.capture.is_nearest() && !writer_.rests;
  }
}

}  // namespace calligraphy
