#include <calligraphy/render/force_limiter.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace calligraphy {

double ForceLimiter::max_step() const noexcept {
  return limit_rate ? std::hypot(in_plane_step, normal_step) : std::numeric_limits<double>::infinity();
}

Eigen::Vector3d ForceLimiter::next(const Eigen::Vector3d& previous, const Eigen::Vector3d& target) const noexcept {
  Eigen::Vector3d force = target;
  if (limit_rate) {
    const Eigen::Vector2d change = (target - previous).head<2>();
    const double length = change.norm();
    force.head<2>() = length <= in_plane_step ? Eigen::Vector2d(target.head<2>())
                                              : Eigen::Vector2d(previous.head<2>() + change * (in_plane_step / length));
    force.z() = previous.z() + std::clamp(target.z() - previous.z(), -normal_step, normal_step);
  }
  const double size = force.norm();
  return size > peak ? Eigen::Vector3d(force * (peak / size)) : force;
}

}  // namespace calligraphy
