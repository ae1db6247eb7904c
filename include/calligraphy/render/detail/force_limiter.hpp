// The last stage before the device: no force steps, none exceeds the peak.
#pragma once

#include <limits>

#include <Eigen/Core>

namespace calligraphy {

/// Brings every change of force in at a limited rate, and at choice a limited jerk, and keeps it within the peak force.
///
/// The target is shortened to `peak`, its direction kept. Each tick the force moves towards it by at most
/// `in_plane_step` within the paper and `normal_step` along z; what is then beyond `peak` is shortened again. That is a
/// projection onto a ball that the last force lies in, so it never lengthens the step: no step exceeds max_step().
///
/// A stage before this one may ask for less than `peak` for one tick. A force that is longer still is first shortened
/// by as much as the smaller of the two steps allows, and what is left of them leads to the target: so its length falls
/// by that much a tick, wherever the target is.
///
/// With `jerk` the step itself changes by at most that much per tick, and in time to stop at the target. Outranked by
/// shortening, by release(), and along z by paper that does not pull: a force that presses, on the way to one that
/// presses, stops at none.
struct ForceLimiter {
  static constexpr double no_limit = std::numeric_limits<double>::infinity();

  double in_plane_step = 0.0;  ///< [N per tick]
  double normal_step = 0.0;    ///< [N per tick]
  double peak = 0.0;           ///< [N]
  bool limit_rate = true;      ///< false: `wang2006`, forces come and go at once
  double jerk = no_limit;      ///< largest change of the step, within the paper and along z each [N per tick^2]
  Eigen::Vector3d last_step = Eigen::Vector3d::Zero();  ///< kept with `jerk` [N]

  double max_step() const noexcept;
  /// The force after `previous` on the way to `target`, no longer than `max_length` if that can be [N, page axes].
  /// `target` is finite, `previous` what the last call gave.
  Eigen::Vector3d next(const Eigen::Vector3d& previous, const Eigen::Vector3d& target,
                       double max_length = no_limit) noexcept;
  /// The force after `previous` on the shortest way to none, by max_step() a tick: the device cannot be trusted.
  Eigen::Vector3d release(const Eigen::Vector3d& previous) noexcept;
};

}  // namespace calligraphy
