#include "paper.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <calligraphy/render/force_terms.hpp>

namespace calligraphy {

Paper::Paper(const RendererOptions& options)
    : options_(options.paper),
      period_(1.0 / options.servo_rate),
      rate_filter_(-std::expm1(-2.0 * std::numbers::pi * options.velocity_cutoff * period_)) {}

void Paper::release() noexcept {
  force_ = {};
  release_friction();
}

void Paper::release_friction() noexcept {
  friction_.release();
  spring_ = spring_rate_ = Point::Zero();
}

const PaperForce& Paper::update(const PenState& pen, const WriterState& writer, double pressure) noexcept {
  if (pen.status != TickStatus::ok) [[unlikely]] {
    if (!pen.holds_force) release();
    return force_;
  }
  const bool is_solid = writer.state == InteractionState::calibration || writer.state == InteractionState::writing;
  force_ = {};
  if (is_solid) press(pen);
  if (force_.normal > 0.0) {
    if (options_.friction.coefficient > 0.0) rub(pen.device_point.head<2>(), std::max(0.0, pressure));
  } else {
    release_friction();
  }
  return force_;
}

/// Eq. (9) and a damper, both of which set in over the onset depth: the damper, because a touch would otherwise be a
/// step; the spring, so that it is never too stiff for the damper at that depth. Paper does not pull, however fast the
/// pen is lifted.
void Paper::press(const PenState& pen) noexcept {
  const double depth = pen.penetration, onset = options_.onset;
  const double share = depth < onset ? depth / onset : 1.0;
  const double strained = depth < onset ? 0.5 * depth * share : depth - 0.5 * onset;
  const double spring = normal_force(options_.stiffness, strained);
  force_.normal = spring;
  if (!(depth > 0.0)) return;
  const double damping = -share * options_.damping * pen.velocity.z();
  force_.viscous.z() = std::max(damping, -spring);
  force_.normal += force_.viscous.z();
}

/// The damper acts on the spring, not on the pen: while the anchor slides along, the spring does not change.
void Paper::rub(const Point& point, double pressure) noexcept {
  const FrictionOptions& friction = options_.friction;
  const Point spring = friction_.update(friction, point, pressure);
  spring_rate_ += rate_filter_ * ((spring - spring_) / period_ - spring_rate_);
  spring_ = spring;
  const Point damping = friction.damping / friction.stiffness * spring_rate_;
  force_.viscous.head<2>() = damping;
  force_.friction = spring + damping;
}

}  // namespace calligraphy
