#include <calligraphy/render/detail/guidance.hpp>

#include <algorithm>
#include <cmath>

#include <calligraphy/render/force_terms.hpp>

namespace calligraphy {
namespace {

/// What is left of the damping where no spring acts, as long as the pen touches the paper: a pen that nobody holds does
/// not coast on.
constexpr double unguided_damping = 0.15;

/// Guidance to the start stops short of the start along the stroke by this share of the tolerance.
constexpr double unguided_start = 0.5;

/// A pen this far from the normal of its closest point is beyond an end: as a share of the distance, plus a slack [m].
constexpr double oblique_share = 0.2, oblique_slack = 1e-5;

/// The part of a velocity that guidance along `way` [m] damps: across the stroke. Along it the pen is free, except
/// where guidance leads that way too: before the start and at a corner that is not passed.
Point damped_part(const Point& velocity, const Point& way, const Point& tangent) noexcept {
  const double along = std::abs(way.dot(tangent));
  const double oblique = std::min(1.0, along / (oblique_share * way.norm() + oblique_slack));
  return velocity - (1.0 - oblique) * velocity.dot(tangent) * tangent;
}

}  // namespace

Guidance::Guidance(const EffectiveOptions& effective)
    : effective_(effective),
      period_(1.0 / effective.options.servo_rate),
      assistance_(effective.options.guidance.assist) {
  const double fade_in = effective.options.guidance.fade_in;
  fade_step_ = fade_in > 0.0 ? 1.0 / (fade_in * effective.options.servo_rate) : 1.0;
}

/// No force, and none to withdraw.
void Guidance::release() noexcept {
  force_.attraction = force_.wrong_way = force_.viscous = force_.total = Point::Zero();
  released_.clear();
}

void Guidance::restart() noexcept {
  release();
  force_.assistance = 1.0;
  assistance_.restart();
  guided_ = false;
}

const GuidanceForce& Guidance::update(const PenState& pen, const WriterState& writer, const Point& sent) noexcept {
  if (pen.status != TickStatus::ok) {
    if (!pen.holds_force) release();
    return force_;
  }
  if (writer.phase == WritingPhase::lifted && !released_.acts() && writer.events == TickEvent::none) {
    return force_;  // nothing guides a pen in the air, and nothing is left to withdraw
  }
  assistance_.update(pen.tip.head<2>(), writer);
  force_.assistance = assistance_.factor();
  pull(pen, writer);
  force_.total = faded(pen, writer, sent);
  return force_;
}

/// The three terms.
void Guidance::pull(const PenState& pen, const WriterState& writer) noexcept {
  force_.attraction = force_.wrong_way = force_.viscous = Point::Zero();
  if (writer.phase == WritingPhase::lifted || writer.phase == WritingPhase::page_written) return;
  const GuidanceOptions& options = effective_.options.guidance;
  const bool saturating = options.law == GuidanceLaw::saturating;
  const bool writing = writer.state == InteractionState::writing;
  const StrokeContact& contact = writer.contact;
  const Point tip = pen.tip.head<2>();
  Point way = Point::Zero();  // where guidance leads
  Point tangent = Point::Zero();
  double share = 0.0;       // of guidance, in the stiffness and the damping
  double resistance = 0.0;  // to writing backwards, likewise
  if (writing) {
    way = contact.closest.point - tip;
    // A writer who began the stroke beyond its start may end it as far beyond its end.
    if (contact.finished) way -= std::min(0.0, way.dot(contact.closest.tangent)) * contact.closest.tangent;
    tangent = contact.closest.tangent;
    resistance = writer.guided ? contact.weight : 0.0;
    share = force_.assistance * (saturating ? 1.0 : resistance);
  } else {
    if (writer.guided) {
      way = way_to_start(writer);
      tangent = writer.direction;
      share = force_.assistance;
    }
    if (writer.rests) resistance = contact.weight;
  }
  const double stiffness = effective_.guidance_stiffness(writer.attraction);
  force_.attraction = attraction_force(stiffness * share, tip, tip + way, effective_.options.rules);
  if (writer.attraction < 1.0) share *= writer.attraction;
  const double slack = options.wrong_way_slack * writer.em;
  const bool resisted = resistance > 0.0 && contact.backwards > slack;
  if (resisted) {
    force_.wrong_way = resistance * wrong_way_force(options.wrong_way_stiffness, options.wrong_way_limit, slack,
                                                    contact.backwards, contact.closest.tangent);
  }
  if (saturating) {
    const double linear = force_.attraction.norm();
    force_.attraction = saturated_force(force_.attraction, options.limit);
    // Across the stroke the stiffness falls with the square of what this falls by.
    if (linear > 0.0) share *= std::sqrt(force_.attraction.norm() / linear);
  }
  const Point velocity = pen.velocity.head<2>();
  // Resistance to writing backwards is not weakened by assistance, nor is its damper.
  const Point guided =
      resisted ? Point(std::max(share, resistance) * velocity) : Point(share * damped_part(velocity, way, tangent));
  force_.viscous = -options.damping * (guided + unguided_damping * (velocity - guided));
}

/// Until the first stretch has shown its direction, guidance acts across that direction only, so that it does not hide
/// it; with GuidanceOptions::to_start also along it, though not up to the start itself, which the pen is about to
/// leave, nor from the stroke, along which a pen that moves backwards is resisted.
Point Guidance::way_to_start(const WriterState& writer) const noexcept {
  const GuidanceOptions& options = effective_.options.guidance;
  const double along = writer.to_start.dot(writer.direction);
  const Point across = writer.to_start - along * writer.direction;
  if (!options.to_start || writer.rests) return across;
  const double free = unguided_start * effective_.options.tolerances.start_distance * writer.em;
  return across + std::copysign(std::max(0.0, std::abs(along) - free), along) * writer.direction;
}

/// Where the closest point jumps, at the start of a stroke and at a feature point, a spring that appears at once would
/// throw the pen, and so would one that vanishes at once where guidance ends: the old one is withdrawn in time while
/// the new one sets in.
Point Guidance::faded(const PenState& pen, const WriterState& writer, const Point& sent) noexcept {
  constexpr TickEvent jumps = TickEvent::stroke_started | TickEvent::feature_passed | TickEvent::contact;
  constexpr TickEvent ends = TickEvent::stroke_finished | TickEvent::stroke_abandoned | TickEvent::lift;
  const GuidanceOptions& options = effective_.options.guidance;
  const bool changed = writer.guided != guided_;
  guided_ = writer.guided;
  const bool lets_go = has_event(writer.events, ends) || (changed && !guided_);
  const Point tip = pen.tip.head<2>(), velocity = pen.velocity.head<2>();
  if (lets_go || changed || has_event(writer.events, jumps)) {
    const double seconds = lets_go ? options.fade_out : options.fade_in;
    released_.take_over(sent, tip, velocity, effective_.guidance_stiffness(1.0), options.damping, seconds / period_);
    fade_ = 0.0;
  }
  Point force = force_.attraction + force_.wrong_way + force_.viscous;
  if (fade_ < 1.0) {
    fade_ = std::min(1.0, fade_ + fade_step_);
    force *= smooth_step(fade_);
  }
  return released_.acts() ? Point(force + released_.next(tip, velocity)) : force;
}

}  // namespace calligraphy
