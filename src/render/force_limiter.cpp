#include <calligraphy/render/force_limiter.hpp>

#include <algorithm>
#include <cmath>

namespace calligraphy {
namespace {

/// The largest first step of a run that ends after `way`, steps getting smaller by `jerk` each.
double braking_step(double way, double jerk) noexcept {
  return std::sqrt(0.25 * jerk * jerk + 2.0 * jerk * way) - 0.5 * jerk;
}

/// One step towards a target `way` off, after the step `last`.
template <typename Vector>
Vector jerk_limited(const Vector& way, const Vector& last, double longest, double jerk) noexcept {
  const double distance = way.norm();
  const double wanted = std::min({distance, longest, std::max(braking_step(distance, jerk), std::min(distance, jerk))});
  Vector step = Vector::Zero();
  if (distance > 0.0) step = way * (wanted / distance);
  const Vector change = step - last;
  const double size = change.norm();
  if (size > jerk) step = last + change * (jerk / size);
  const double length = step.norm();
  return length > longest ? Vector(step * (longest / length)) : step;
}

}  // namespace

double ForceLimiter::max_step() const noexcept {
  return limit_rate ? std::hypot(in_plane_step, normal_step) : no_limit;
}

Eigen::Vector3d ForceLimiter::next(const Eigen::Vector3d& previous, const Eigen::Vector3d& target) noexcept {
  Eigen::Vector3d force = target;
  if (limit_rate) {
    const Eigen::Vector2d change = (target - previous).head<2>();
    const double normal_change = target.z() - previous.z();
    if (jerk < no_limit) {
      using Line = Eigen::Matrix<double, 1, 1>;
      last_step.head<2>() = jerk_limited<Eigen::Vector2d>(change, last_step.head<2>(), in_plane_step, jerk);
      last_step.z() = jerk_limited<Line>(Line(normal_change), Line(last_step.z()), normal_step, jerk)[0];
      force = previous + last_step;
    } else {
      const double length = change.norm();
      force.head<2>() = length <= in_plane_step
                            ? Eigen::Vector2d(target.head<2>())
                            : Eigen::Vector2d(previous.head<2>() + change * (in_plane_step / length));
      force.z() = previous.z() + std::clamp(normal_change, -normal_step, normal_step);
    }
  }
  const double size = force.norm();
  if (size <= peak) return force;
  force *= peak / size;
  last_step = force - previous;
  return force;
}

Eigen::Vector3d ForceLimiter::release(const Eigen::Vector3d& previous) noexcept {
  last_step.setZero();
  const double size = previous.norm();
  const double step = max_step();
  return size <= step ? Eigen::Vector3d(0.0, 0.0, 0.0) : Eigen::Vector3d(previous * (1.0 - step / size));
}

}  // namespace calligraphy
