#include <calligraphy/render/detail/force_limiter.hpp>

#include <algorithm>
#include <cmath>

#include "collision/length.hpp"

namespace calligraphy {
namespace {

Eigen::Vector3d shortened(const Eigen::Vector3d& force, double max_length) noexcept {
  const double size = norm(force);
  return size > max_length ? Eigen::Vector3d(force * (max_length / size)) : force;
}

/// Maximum first step of a sequence that ends after `way`, each step smaller by `jerk` than the last. With k whole
/// jerks in it, way = (k + 1) (step - k jerk / 2).
double braking_step(double way, double jerk) noexcept {
  const double smooth = std::sqrt(0.25 * jerk * jerk + 2.0 * jerk * way) - 0.5 * jerk;
  const double whole = jerk > 0.0 ? std::floor(smooth / jerk) : 0.0;
  return way / (whole + 1.0) + 0.5 * whole * jerk;
}

/// One step towards a target at a distance of `way`, after the step `last`.
template <typename Vector>
Vector jerk_limited(const Vector& way, const Vector& last, double max_length, double jerk) noexcept {
  const double distance = way.norm();
  const double wanted = std::min(max_length, braking_step(distance, jerk));
  Vector step = Vector::Zero();
  if (distance > 0.0) step = way * (wanted / distance);
  const Vector change = step - last;
  const double size = change.norm();
  if (size > jerk) step = last + change * (jerk / size);
  const double length = step.norm();
  return length > max_length ? Vector(step * (max_length / length)) : step;
}

}  // namespace

double ForceLimiter::max_step() const noexcept {
  return limit_rate ? Eigen::Vector2d(in_plane_step, normal_step).norm() : no_limit;
}

Eigen::Vector3d ForceLimiter::next(const Eigen::Vector3d& previous, const Eigen::Vector3d& target,
                                   double max_length) noexcept {
  double most = std::min(peak, max_length);
  Eigen::Vector3d force = shortened(target, most);
  if (!limit_rate) return force;
  double taken = 0.0;
  if (max_length < peak) {
    const double size = norm(previous);
    taken = std::clamp(size - most, 0.0, std::min(in_plane_step, normal_step));
    most = std::max(most, size - taken);
  }
  const Eigen::Vector2d change = (force - previous).head<2>();
  const double normal_change = force.z() - previous.z();
  if (jerk < no_limit) {
    using Line = Eigen::Matrix<double, 1, 1>;
    last_step.head<2>() = jerk_limited<Eigen::Vector2d>(change, last_step.head<2>(), in_plane_step - taken, jerk);
    last_step.z() = jerk_limited<Line>(Line(normal_change), Line(last_step.z()), normal_step - taken, jerk)[0];
    force = previous + last_step;
  } else {
    const double length = change.norm();
    const double reach = in_plane_step - taken;
    if (length > reach) force.head<2>() = previous.head<2>() + change * (reach / length);
    force.z() = previous.z() + std::clamp(normal_change, taken - normal_step, normal_step - taken);
  }
  force = shortened(force, most);
  // Shortening removes part of the path over which a jerk-limited force slows down, so it could overshoot.
  if (previous.z() >= 0.0 && target.z() >= 0.0) force.z() = std::max(0.0, force.z());
  // A shortening step is no rate from which the force would have to slow down.
  last_step = taken > 0.0 ? Eigen::Vector3d(0.0, 0.0, 0.0) : Eigen::Vector3d(force - previous);
  return force;
}

Eigen::Vector3d ForceLimiter::release(const Eigen::Vector3d& previous) noexcept {
  last_step.setZero();
  const double size = norm(previous);
  const double step = max_step();
  return size <= step ? Eigen::Vector3d(0.0, 0.0, 0.0) : Eigen::Vector3d(previous * (1.0 - step / size));
}

}  // namespace calligraphy
