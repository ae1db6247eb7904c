#include "stroke_sequencer.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "collision/length.hpp"

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

bool is_within(const Eigen::AlignedBox2d& box, const Point& point) {
  return box.min().x() <= point.x() && point.x() <= box.max().x() && box.min().y() <= point.y() &&
         point.y() <= box.max().y();
}

}  // namespace

StrokeSequencer::StrokeSequencer(std::vector<PlacedCharacter> page, const RendererOptions& options,
                                 const Capabilities& capabilities, const MotionMapping& mapping, bool lets_go)
    : page_(std::move(page), options),
      stroke_{options.nearest, options.guidance.space, options.rules},
      tolerances_(options.tolerances),
      box_hysteresis_(is_printed(options.rules) ? 0.0 : box_hysteresis),
      lift_between_strokes_(options.contact.lift_between_strokes),
      leads_to_start_(options.guidance.to_start),
      lets_go_(lets_go),
      mapping_(mapping),
      compliance_(mapping.scale * mapping.scale / options.grip_stiffness) {
  const double dry_friction = capabilities.coulomb_friction + options.paper.friction.coefficient * usual_pressure;
  hidden_way_ = mapping.scale * dry_friction / options.grip_stiffness;
  restart();
}

void StrokeSequencer::restart() noexcept {
  writer_ = {};
  inside_box_ = false;
  capture_.restart();
  activate(0, 0);
}

bool StrokeSequencer::skip() noexcept {
  if (writer_.state == InteractionState::writing || all_written() || is_character_written()) return false;
  const int next = writer_.stroke + 1;
  if (next < static_cast<int>(character_->strokes.size())) {
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

const WriterState& StrokeSequencer::update(const PenState& pen) noexcept {
  using State = InteractionState;
  const Point tip = pen.tip.head<2>();
  writer_.events = TickEvent::none;
  if (pen.status != TickStatus::ok) return writer_;
  const TransitionInput input = advance(pen);
  const State before = writer_.state, after = next_state(before, input);
  writer_.state = after;
  if (before == State::separation && after != State::separation) writer_.events |= TickEvent::contact;
  if (before == State::writing && after != State::writing) {
    input.stroke_finished ? finish_stroke(tip) : abandon_stroke(tip);
  }
  if (before != State::writing && after == State::writing) start_stroke(pen);
  if (before != State::separation && after == State::separation) lift();
  writer_.to_start = all_written() ? Point(Point::Zero()) : Point(due_->geometry.start() - tip);
  writer_.attraction = after == State::writing ? writer_.contact.attraction : due_->geometry.first_attraction();
  writer_.phase = phase(tip);
  writer_.guided = is_guided();
  return writer_;
}

TransitionInput StrokeSequencer::advance(const PenState& pen) noexcept {
  TransitionInput input;
  input.contact = pen.contact;
  if (all_written()) return input;

  const Point tip = pen.tip.head<2>();
  const bool writing = writer_.state == InteractionState::writing;
  const Eigen::AlignedBox2d& box = character_->box;
  if (is_within(box, tip)) {
    inside_box_ = true;
  } else if (inside_box_) {
    const double hysteresis = box_hysteresis_ * writer_.em * (writing ? writing_hysteresis : 1.0);
    inside_box_ = box.exteriorDistance(tip) <= hysteresis;
  }
  input.inside_box = inside_box_;
  input.may_start = writer_.phase != WritingPhase::finished;
  if (writing) {
    if (input.contact) write_on(pen);
    const bool leaves = !input.contact || !input.inside_box;
    if (leaves) due_->follower.leave();
    input.stroke_finished = is_finished(leaves);
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

void StrokeSequencer::set_out(const Point& tip) noexcept {
  capture_.put_down(tip, character_->starts, static_cast<std::size_t>(writer_.stroke));
  due_->follower.begin(tip, capture_.misplaced());
}

bool StrokeSequencer::begins(const PenState& pen) noexcept {
  const Point tip = pen.tip.head<2>(), from = capture_.begin();
  const auto due = static_cast<std::size_t>(writer_.stroke);
  const CaptureVerdict verdict = capture_.update(tip, character_->starts, due, writer_.em, tolerances_);
  if (character_->starts[due].bends) {  // its ends do not say how it was written
    if (capture_.begin() != from) due_->follower.begin(capture_.begin(), capture_.misplaced());
    if (pen.on_paper) due_->follower.update(tip, hand(pen));
  }
  if (verdict == CaptureVerdict::begun) return true;
  if (verdict == CaptureVerdict::another_stroke) writer_.rests = false;
  if (writer_.rests) writer_.contact = due_->geometry.update(tip, stroke_);
  return false;
}

void StrokeSequencer::write_on(const PenState& pen) noexcept {
  const Point tip = pen.tip.head<2>();
  writer_.contact = due_->geometry.update(tip, stroke_);
  if (writer_.contact.passed_feature) writer_.events |= TickEvent::feature_passed;
  hand_ = hand(pen);
  if (pen.on_paper) due_->follower.update(tip, hand_);
  writer_.covered = due_->follower.covered();
}

/// A stroke is finished at its end, or where the pen `leaves` it earlier.
bool StrokeSequencer::is_finished(bool leaves) const noexcept {
  if (tolerances_.coverage == 0.0) return writer_.contact.finished;
  return (leaves || due_->follower.is_at_end(hidden_way_)) && due_->follower.accepts(2.0 * hidden_way_);
}

[[gnu::noinline]] void StrokeSequencer::start_stroke(const PenState& pen) noexcept {
  writer_.events |= TickEvent::stroke_started;
  writer_.rests = false;
  due_->geometry.begin(capture_.begin());
  const bool is_followed = character_->starts[static_cast<std::size_t>(writer_.stroke)].bends;
  if (!is_followed) due_->follower.begin(capture_.begin(), capture_.misplaced());
  write_on(pen);
}

[[gnu::noinline]] void StrokeSequencer::finish_stroke(const Point& tip) noexcept {
  writer_.events |= TickEvent::stroke_finished;
  capture_.written(due_->geometry.start());
  const int next = writer_.stroke + 1;
  if (next < static_cast<int>(character_->strokes.size())) {
    activate(writer_.character, next);
  } else {
    writer_.events |= TickEvent::character_finished;
    if (writer_.character + 1 == page_.size()) writer_.events |= TickEvent::page_finished;
    // The box of the next character is elsewhere, and outside a box the paper does not press back: it would give way
    // under a pen that is still pressed on this character.
    if (lift_between_strokes_) {
      writer_.stroke = next;
    } else {
      activate(writer_.character + 1, 0);
    }
  }
  if (lift_between_strokes_) {
    writer_.phase = WritingPhase::finished;
  } else if (!all_written()) {
    set_out(tip);
  }
}

[[gnu::noinline]] void StrokeSequencer::abandon_stroke(const Point& tip) noexcept {
  writer_.events |= TickEvent::stroke_abandoned;
  due_->geometry.reload();
  set_out(tip);
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
    capture_.restart();
  }
  writer_.character = character;
  writer_.stroke = stroke;
  writer_.rests = false;
  character_ = character < page_.size() ? &page_[character] : nullptr;
  if (all_written()) return;
  due_ = &character_->strokes[static_cast<std::size_t>(stroke)];
  writer_.geometry = &due_->geometry;
  writer_.em = character_->em;
  writer_.direction = character_->starts[static_cast<std::size_t>(stroke)].direction;
}

/// Refines the paper's state as docs/capture.md draws it.
WritingPhase StrokeSequencer::phase(const Point& tip) const noexcept {
  if (writer_.state == InteractionState::separation) return WritingPhase::lifted;
  if (all_written()) return WritingPhase::page_written;
  if (writer_.state == InteractionState::writing) {
    return keeps_hold() ? WritingPhase::guided : WritingPhase::released;
  }
  return writer_.phase == WritingPhase::finished ? WritingPhase::finished : phase_before_stroke(tip);
}

WritingPhase StrokeSequencer::phase_before_stroke(const Point& tip) const noexcept {
  const CaptureVerdict verdict = capture_.verdict();
  if (verdict == CaptureVerdict::another_stroke) return WritingPhase::other_stroke;
  // The first stretch leads away from the start.
  const double from_start = std::min(writer_.to_start.norm(), (capture_.begin() - due_->geometry.start()).norm());
  const bool is_late = writer_.rests && writer_.contact.arc > end_share * due_->geometry.length();
  if (is_late && (tip - due_->geometry.end()).norm() < from_start) return WritingPhase::at_end;
  if (from_start <= tolerances_.start_distance * writer_.em) {
    return verdict == CaptureVerdict::wrong_direction ? WritingPhase::turned_away : WritingPhase::at_start;
  }
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
  if (writer_.state != InteractionState::calibration) return false;
  switch (writer_.phase) {
    case WritingPhase::page_written:
    case WritingPhase::finished:
    case WritingPhase::other_stroke:
      return false;
    case WritingPhase::at_start:
      return capture_.is_nearest();
    default:
      return leads_to_start_ && capture_.is_nearest() && !writer_.rests;
  }
}

}  // namespace calligraphy
