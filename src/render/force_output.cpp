#include "force_output.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/require.hpp"
#include "collision/length.hpp"

namespace calligraphy {
namespace {

/// The force follows a pen without delay up to this speed and this change of speed per tick [m/s].
constexpr double max_followed_speed = 1.0, max_followed_change = 0.3;

/// The budget in page axes, where forces are 1 / scale times those of the device, masses and damping 1 / scale^2 times
/// (MotionMapping).
EnergyBudget energy_budget(const RendererOptions& options, const Capabilities& capabilities, double scale,
                           bool has_own_law) {
  EnergyBudgetOptions energy;
  energy.charges_encoder = has_own_law;
  energy.budget = options.energy.budget;
  if (capabilities.apparent_mass > 0.0) energy.mass = capabilities.apparent_mass / (scale * scale);
  energy.encoder_step = capabilities.encoder_step * scale;
  energy.observer.hand_speed *= scale;
  energy.observer.max_gap = options.energy.max_gap;
  energy.observer.scale = scale;
  energy.observer.delay = capabilities.sample_delay;
  return EnergyBudget(energy, 1.0 / options.servo_rate);
}

}  // namespace

ForceOutput::ForceOutput(const RendererOptions& options, const Capabilities& capabilities, const MotionMapping& mapping,
                         double max_guidance_stiffness, bool has_own_law)
    : mapping_(mapping),
      observes_energy_(options.energy.limited()),
      period_(1.0 / options.servo_rate),
      in_plane_{max_guidance_stiffness + options.guidance.wrong_way_stiffness, options.guidance.damping},
      normal_{options.paper.stiffness, options.paper.damping},
      paper_onset_(options.paper.onset) {
  require(capabilities.peak_force > 0.0, "peak force of the device", capabilities.peak_force, "N", "above 0");
  const FrictionOptions& friction = options.paper.friction;
  if (friction.coefficient > 0.0) {
    in_plane_.stiffness += friction.stiffness;
    in_plane_.damping += friction.damping;
  }
  limiter_.in_plane_step = options.limits.in_plane_rate / options.servo_rate / mapping.scale;
  limiter_.normal_step = options.limits.normal_rate / options.servo_rate / mapping.scale;
  limiter_.peak = capabilities.peak_force / mapping.scale;
  if (observes_energy_) energy_ = energy_budget(options, capabilities, mapping.scale, has_own_law);
  if (options.limits.thermal_time_constant > 0.0) {
    thermal_.peak = limiter_.peak;
    thermal_.continuous = std::min(capabilities.continuous_force, capabilities.peak_force) / mapping.scale;
    thermal_.time_constant = options.limits.thermal_time_constant;
  }
}

void ForceOutput::restart() noexcept {
  energy_.restart();
  thermal_.heat = 0.0;
  sent_ = {};
}

const SentForce& ForceOutput::update(const PenState& pen, const GuidanceForce& guidance,
                                     const PaperForce& paper) noexcept {
  Eigen::Vector3d force;
  force.head<2>() = guidance.total + paper.friction;
  force.z() = paper.normal + guidance.normal;
  if (pen.holds_force) force = sent_.page;
  // If no force was sent, none is held, not even the brake of an exhausted budget.
  const bool is_trusted = pen.status == TickStatus::ok || (pen.holds_force && norm(force) > 0.0);
  sent_.viscous.head<2>() = paper.viscous.head<2>() + guidance.viscous;
  sent_.viscous.z() = paper.viscous.z();

  double max_force = ForceLimiter::no_limit;
  if (thermal_.peak > 0.0) {
    max_force = thermal_.max_force();
    sent_.is_warm = thermal_.is_warm() && dot(force, force) > max_force * max_force;
  }
  if (observes_energy_) {
    account(pen);
    if (guidance.power > 0.0) energy_.earn(guidance.power * std::clamp(pen.time - time_, 0.0, period_));
    time_ = pen.time;
    force = affordable(pen, shortened(force, std::min(limiter_.peak, max_force)));
    max_force = std::min(max_force, energy_.max_force());
  }
  if (!is_trusted) [[unlikely]] {
    sent_.page = limiter_.release(sent_.page);
  } else if (limiter_.reaches(sent_.page, force, max_force)) [[likely]] {
    sent_.page = force;
  } else {
    sent_.page = limiter_.next(sent_.page, force, allowance(pen), max_force);
  }
  if (observes_energy_) energy_.sent(sent_.page);
  if (thermal_.peak > 0.0) {
    thermal_.held(norm(sent_.page), period_);
    sent_.heat = thermal_.heat;
  }
  sent_.guidance = sent_.page.head<2>() - paper.friction;
  sent_.device = mapping_.force_to_device(sent_.page);
  return sent_;
}

/// The energy account sees the force at work: behind a servo it may be less than the one sent.
void ForceOutput::account(const PenState& pen) noexcept {
  const bool is_as_sent = pen.force == sent_.device || !is_finite(pen.force);
  energy_.acted(is_as_sent ? sent_.page : mapping_.force_to_page(pen.force), pen.ticks, pen.settling);
}

Eigen::Vector3d ForceOutput::affordable(const PenState& pen, const Eigen::Vector3d& wanted) noexcept {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const bool is_known = pen.status == TickStatus::ok;
  Eigen::Vector3d force =
      energy_.next(is_known ? pen.position : Eigen::Vector3d(unknown, unknown, unknown), wanted, sent_.viscous);
  // Paper does not pull, however fast the pen is lifted.
  if (wanted.z() >= 0.0) force.z() = std::max(0.0, force.z());
  sent_.energy_given = energy_.energy_given();
  return force;
}

/// Change of the springs and dampers due to the motion of the pen since the previous sample.
ForceAllowance ForceOutput::allowance(const PenState& pen) const noexcept {
  const Eigen::Vector3d motion = pen.motion(), change = pen.velocity_change();
  const double way = std::abs(motion.z());
  // The damper of the paper sets in with depth.
  const double onset = way < paper_onset_ ? way / paper_onset_ : 1.0;
  return allowance({motion.head<2>().norm(), way},
                   {change.head<2>().norm(), std::abs(change.z()) + onset * std::abs(pen.velocity.z())});
}

/// Change due to a motion by `way` [m] and a change of the velocity [m/s], each in the plane and along the normal.
ForceAllowance ForceOutput::allowance(Point way, Point velocity_change) const noexcept {
  way = way.cwiseMin(max_followed_speed * mapping_.scale * period_);
  velocity_change = velocity_change.cwiseMin(max_followed_change * mapping_.scale);
  return {in_plane_.force(way.x(), velocity_change.x()), normal_.force(way.y(), velocity_change.y())};
}

double ForceOutput::max_step() const noexcept {
  constexpr double any = std::numeric_limits<double>::max();
  const ForceAllowance most = allowance({any, any}, {any, any});
  return Eigen::Vector2d(limiter_.in_plane_step + most.in_plane, limiter_.normal_step + most.normal).norm();
}

}  // namespace calligraphy
