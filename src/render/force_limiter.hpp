// The last stage before the device: limits the peak and the rate of the force without lagging behind the pen.
#pragma once

#include <limits>

#include <Eigen/Core>

namespace calligraphy {

/// How far the motion of the pen lets the force change in a tick, beyond the steps of the limiter [N].
struct ForceAllowance {
  double in_plane = 0.0;
  double normal = 0.0;
};

/// Limits the rate of the force and keeps it within the peak force.
///
/// The target is scaled down to `peak`, preserving its direction. In each tick the force moves towards it by at most
/// `in_plane_step` in the paper plane and `normal_step` along z, and further by the allowance: what the springs and
/// dampers change because the pen has moved. While nothing but the pen moves, the distance from the target therefore
/// never grows, and it shrinks by the steps: a target that jumps is approached at the limited rate, and followed
/// without lag once it is reached. A limiter without the allowance lags behind a spring, and a lagging spring drives
/// the pen (docs/stability-derivation.md).
///
/// An earlier stage may request a limit below `peak` for one tick; it takes effect at once.
struct ForceLimiter {
  static constexpr double no_limit = std::numeric_limits<double>::infinity();

  double in_plane_step = 0.0;  ///< infinite: no limit [N per tick]
  double normal_step = 0.0;    ///< likewise [N per tick]
  double peak = 0.0;           ///< [N]

  /// Whether next() returns `target` itself, whatever the allowance: the usual case, decided without a square root.
  bool reaches(const Eigen::Vector3d& previous, const Eigen::Vector3d& target, double max_length) const noexcept {
    const double most = peak < max_length ? peak : max_length;
    const double x = target.x() - previous.x(), y = target.y() - previous.y(), z = target.z() - previous.z();
    const double square = target.x() * target.x() + target.y() * target.y() + target.z() * target.z();
    return square <= most * most && x * x + y * y <= in_plane_step * in_plane_step && z <= normal_step &&
           z >= -normal_step;
  }

  /// Maximum change per tick on a pen at rest [N].
  double max_step() const noexcept;
  /// The next force from `previous` towards `target`, at most `max_length` long [N, page axes]. `target` must be
  /// finite.
  Eigen::Vector3d next(const Eigen::Vector3d& previous, const Eigen::Vector3d& target,
                       const ForceAllowance& allowance = {}, double max_length = no_limit) const noexcept;
  /// The next force from `previous` straight to zero at the limited rate, for a device that cannot be trusted.
  Eigen::Vector3d release(const Eigen::Vector3d& previous) const noexcept;
};

}  // namespace calligraphy
