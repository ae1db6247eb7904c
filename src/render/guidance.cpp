#include "guidance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <calligraphy/render/force_terms.hpp>

namespace calligraphy {
namespace {

/// Guidance to the start stops short of the start along the stroke by this share of the tolerance.
constexpr double unguided_start = 0.5;

}  // namespace

Guidance::Guidance(const EffectiveOptions& effective, std::unique_ptr<GuidanceLaw> law)
    : law_(std::move(law)),
      period_(1.0 / effective.options.servo_rate),
      assistance_(effective.options.guidance.assist),
      effective_(effective) {
  input_.damping = effective.options.guidance.damping;
  input_.max_stiffness = effective.guidance_limit;
  input_.dt = period_;
  const double fade_in = effective.options.guidance.fade_in;
  fade_step_ = fade_in > 0.0 ? 1.0 / (fade_in * effective.options.servo_rate) : 1.0;
}

/// No force, and none to withdraw.
void Guidance::release() noexcept {
  force_.attraction = force_.wrong_way = force_.viscous = force_.total = Point::Zero();
  force_.normal = force_.power = released_normal_ = 0.0;
  released_.clear();
}

void Guidance::restart() noexcept {
  release();
  force_.assistance = 1.0;
  assistance_.restart();
  guided_ = begun_ = false;
  error_ = nullptr;
}

const GuidanceForce& Guidance::update(PenState& pen, const WriterState& writer, const Point& sent) noexcept {
  if (pen.status != TickStatus::ok) [[unlikely]] {
    if (!pen.holds_force) release();
    return force_;
  }
  if (writer.state == InteractionState::separation && !released_.acts() && released_normal_ == 0.0 &&
      writer.events == TickEvent::none) {
    return force_;  // nothing guides a pen in the air, and nothing is left to withdraw
  }
  normal_before_ = force_.normal;
  assistance_.update(pen.tip.head<2>(), writer);
  force_.assistance = assistance_.factor();
  pull(pen, writer);
  force_.total = faded(pen, writer, sent);
  if (pen.status != TickStatus::ok) [[unlikely]] {  // the law has failed: its next force fades in again
    release();
    fade_ = 0.0;
  }
  return force_;
}

/// Computes the three terms, and the law's addition to the normal force of the paper.
void Guidance::pull(PenState& pen, const WriterState& writer) noexcept {
  constexpr TickEvent attempts = TickEvent::contact | TickEvent::stroke_finished | TickEvent::stroke_abandoned;
  force_.attraction = force_.wrong_way = force_.viscous = Point::Zero();
  force_.normal = force_.power = 0.0;
  if (writer.state == InteractionState::separation || writer.phase == WritingPhase::page_written) return;
  if (has_event(writer.events, attempts)) begun_ = false;
  const GuidanceOptions& options = effective_.options.guidance;
  const StrokeContact& contact = writer.contact;
  input_.tip = pen.tip.head<2>();
  input_.velocity = pen.velocity.head<2>();
  input_.writing = writer.state == InteractionState::writing;
  double resistance = 0.0;  // to writing backwards, in stiffness and damping
  if (input_.writing ? writer.guided : writer.rests) resistance = contact.weight;
  const double slack = options.wrong_way_slack * writer.em;
  const bool resisted = resistance > 0.0 && contact.backwards > slack;
  if (resisted) {
    force_.wrong_way = resistance * wrong_way_force(options.wrong_way_stiffness, options.wrong_way_limit, slack,
                                                    contact.backwards, contact.closest.tangent);
  }
  input_.resistance = resisted ? resistance : 0.0;
  if (!writer.guided) {
    force_.viscous = resisted ? guidance_damper(input_, 0.0)
                              : Point(-input_.damping * (unguided_damping * input_.velocity));
    return;
  }
  lead(writer);
  if (effective_.traits.sees_stroke) show_stroke(pen, writer);
  const GuidanceTerms terms = ask(pen, writer);
  force_.attraction = effective_.law_share * terms.spring;
  force_.viscous = terms.damper;
  force_.normal = terms.normal;
  force_.power = effective_.traits.power;
}

/// Sets where guidance leads.
void Guidance::lead(const WriterState& writer) noexcept {
  const StrokeContact& contact = writer.contact;
  if (input_.writing) {
    input_.tangent = contact.closest.tangent;
    input_.weight = contact.weight;
    input_.way = contact.closest.point - input_.tip;
    // A writer who began the stroke beyond its start may end it as far beyond its end.
    if (contact.finished) input_.way -= std::min(0.0, input_.way.dot(input_.tangent)) * input_.tangent;
  } else {
    input_.tangent = writer.direction;
    input_.weight = 1.0;
    input_.way = way_to_start(writer);
  }
  input_.target = input_.tip + input_.way;
  input_.attraction = writer.attraction;
  input_.stiffness = effective_.guidance_stiffness(writer.attraction);
  input_.share = effective_.traits.lets_go ? force_.assistance * input_.weight : force_.assistance;
}

/// Sets the inputs that not every law reads.
[[gnu::noinline]] void Guidance::show_stroke(const PenState& pen, const WriterState& writer) noexcept {
  StrokeContact contact = writer.contact;
  if (!input_.writing) {
    contact = {};
    contact.closest.point = writer.geometry->start();
    contact.closest.distance = writer.to_start.norm();
  }
  const StrokeElement& element = writer.geometry->element(contact.element);
  input_.nearest = contact.closest.point;
  input_.distance = contact.closest.distance;
  input_.curvature = element.curvature(contact.closest.parameter);
  input_.feature = element.point(1.0);
  input_.arc = contact.arc;
  input_.left = writer.geometry->length() - contact.arc;
  input_.backwards = contact.backwards;
  input_.to_start = writer.to_start;
  input_.depth = pen.penetration;
  input_.em = writer.em;
}

/// A law that throws, or returns a force that is not finite, gives no force.
GuidanceTerms Guidance::ask(PenState& pen, const WriterState& writer) noexcept {
  try {
    if (!begun_) law_->begin(*writer.geometry);
    begun_ = true;
    const GuidanceTerms terms = law_->force(input_);
    const Point force = terms.spring + terms.damper;
    const double sum = force.x() + force.y() + terms.normal;
    if (sum - sum == 0.0) return terms;
  } catch (...) {
    if (!error_) error_ = std::current_exception();
  }
  pen.status = TickStatus::bad_law;
  return {};
}

/// Until the first stretch has shown its direction, guidance acts only across the direction of the stroke, so as not to
/// mask it. With GuidanceOptions::to_start it also acts along it, but not as far as the start itself, which the pen is
/// about to leave, nor on a pen that rests on the stroke, where moving backwards is resisted.
Point Guidance::way_to_start(const WriterState& writer) const noexcept {
  const GuidanceOptions& options = effective_.options.guidance;
  const double along = writer.to_start.dot(writer.direction);
  const Point across = writer.to_start - along * writer.direction;
  if (!options.to_start || writer.rests) return across;
  const double free = unguided_start * effective_.options.tolerances.start_distance * writer.em;
  return across + std::copysign(std::max(0.0, std::abs(along) - free), along) * writer.direction;
}

/// Where the closest point jumps, at the start of a stroke and at a feature point, a spring that appears at once would
/// throw the pen, and so would one that vanishes at once where guidance ends: the old one is withdrawn gradually while
/// the new one sets in.
Point Guidance::faded(const PenState& pen, const WriterState& writer, const Point& sent) noexcept {
  constexpr TickEvent jumps = TickEvent::stroke_started | TickEvent::feature_passed | TickEvent::contact;
  // A stroke that is decided in the air, or by the next one, has let go before.
  const TickEvent ends = writer.state == InteractionState::calibration
                             ? TickEvent::lift | TickEvent::stroke_finished | TickEvent::stroke_abandoned
                             : TickEvent::lift;
  const GuidanceOptions& options = effective_.options.guidance;
  const bool changed = writer.guided != guided_;
  guided_ = writer.guided;
  const bool lets_go = has_event(writer.events, ends) || (changed && !guided_);
  const Point tip = pen.tip.head<2>(), velocity = pen.velocity.head<2>();
  if (lets_go || changed || has_event(writer.events, jumps)) [[unlikely]] {
    const double seconds = lets_go ? options.fade_out : options.fade_in;
    released_.take_over(sent, tip, velocity, effective_.guidance_stiffness(1.0), options.damping, seconds / period_);
    fade_ = 0.0;
    released_normal_ = normal_before_;
    normal_left_ = 1.0;
    normal_step_ = seconds > period_ ? period_ / seconds : 1.0;
  }
  Point force = force_.attraction + force_.wrong_way + force_.viscous;
  if (fade_ < 1.0) {
    fade_ = std::min(1.0, fade_ + fade_step_);
    force *= smooth_step(fade_);
    force_.normal *= smooth_step(fade_);
  }
  if (released_normal_ != 0.0) [[unlikely]] {
    normal_left_ = std::max(0.0, normal_left_ - normal_step_);
    force_.normal += smooth_step(normal_left_) * released_normal_;
    if (normal_left_ == 0.0) released_normal_ = 0.0;
  }
  return released_.acts() ? Point(force + released_.next(tip, velocity)) : force;
}

}  // namespace calligraphy
