// The last stage before the device: no force steps, none exceeds the peak.
#pragma once

#include <Eigen/Core>

namespace calligraphy {

/// Brings every change of force in at a limited rate and keeps the sum within the peak force.
///
/// Each tick the force moves towards its target by at most `in_plane_step` within the paper and `normal_step` along z;
/// then it is shortened to `peak`, its direction kept. Shortening is a projection onto a ball that the last force lies
/// in, so it never lengthens the step: no step exceeds max_step().
struct ForceLimiter {
  double in_plane_step = 0.0;  ///< [N per tick]
  double normal_step = 0.0;    ///< [N per tick]
  double peak = 0.0;           ///< [N]
  bool limit_rate = true;      ///< false: `wang2006`, forces come and go at once

  double max_step() const noexcept;
  /// The force after `previous` on the way to `target` [N, page axes]. `target` is finite.
  Eigen::Vector3d next(const Eigen::Vector3d& previous, const Eigen::Vector3d& target) const noexcept;
};

}  // namespace calligraphy
