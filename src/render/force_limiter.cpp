#include "force_limiter.hpp"

#include <algorithm>
#include <cmath>

#include "collision/length.hpp"

namespace calligraphy {
double ForceLimiter::max_step() const noexcept { return Eigen::Vector2d(in_plane_step, normal_step).norm(); }

Eigen::Vector3d ForceLimiter::next(const Eigen::Vector3d& previous, const Eigen::Vector3d& target,
                                   const ForceAllowance& allowance, double max_length) const noexcept {
  const double most = std::min(peak, max_length);
  Eigen::Vector3d force = shortened(target, most);
  if (in_plane_step == no_limit && normal_step == no_limit) return force;
  const Eigen::Vector2d change = (force - previous).head<2>();
  const double length = change.norm();
  const double reach = in_plane_step + allowance.in_plane;
  if (length > reach) force.head<2>() = previous.head<2>() + change * (reach / length);
  const double normal_reach = normal_step + allowance.normal;
  force.z() = previous.z() + std::clamp(force.z() - previous.z(), -normal_reach, normal_reach);
  // This projects onto a ball, so it lengthens no step from a force inside it.
  return shortened(force, most);
}

[[gnu::noinline]] Eigen::Vector3d ForceLimiter::release(const Eigen::Vector3d& previous) const noexcept {
  const double size = norm(previous);
  // If only one step is unlimited, the other one limits.
  const auto finite = [](double step) { return step < no_limit ? step : 0.0; };
  const double limited = Eigen::Vector2d(finite(in_plane_step), finite(normal_step)).norm();
  const double step = limited > 0.0 ? limited : no_limit;
  return size <= step ? Eigen::Vector3d(0.0, 0.0, 0.0) : Eigen::Vector3d(previous * (1.0 - step / size));
}

}  // namespace calligraphy
