// The last stage before the device: limits the peak, the rate and the jerk of the force.
#pragma once

#include <limits>

#include <Eigen/Core>

namespace calligraphy {

/// Limits the rate of the force, optionally its jerk, and keeps it within the peak force.
///
/// The target is scaled down to `peak`, preserving its direction. In each tick the force moves towards it by at most
/// `in_plane_step` in the paper plane and `normal_step` along z; a result above `peak` is scaled down again. This is a
/// projection onto a ball that contains the last force, so it never lengthens the step: no step exceeds max_step().
///
/// An earlier stage may request a limit below `peak` for one tick. A force above that limit is first shortened by as
/// much as the smaller of the two steps allows; the rest of the steps leads towards the target. Its length thus
/// decreases by that much per tick, wherever the target is.
///
/// With `jerk` the step itself changes by at most that much per tick, early enough to stop at the target. Shortening
/// and release() take precedence over the jerk limit. So does, along z, that paper does not pull: between two forces
/// that press, the normal force never overshoots below zero.
struct ForceLimiter {
  static constexpr double no_limit = std::numeric_limits<double>::infinity();

  double in_plane_step = 0.0;  ///< [N per tick]
  double normal_step = 0.0;    ///< [N per tick]
  double peak = 0.0;           ///< [N]
  bool limit_rate = true;      ///< false: `wang2006`, forces change without a limit
  double jerk = no_limit;      ///< maximum change of the step, in plane and along z separately [N per tick^2]
  Eigen::Vector3d last_step = Eigen::Vector3d::Zero();  ///< state, used with `jerk` [N]

  double max_step() const noexcept;
  /// The next force from `previous` towards `target`, at most `max_length` long where the step limits permit it [N,
  /// page axes]. `target` must be finite, and `previous` the result of the last call.
  Eigen::Vector3d next(const Eigen::Vector3d& previous, const Eigen::Vector3d& target,
                       double max_length = no_limit) noexcept;
  /// The next force from `previous` straight to zero, by max_step() per tick: for when the device cannot be trusted.
  Eigen::Vector3d release(const Eigen::Vector3d& previous) noexcept;
};

}  // namespace calligraphy
