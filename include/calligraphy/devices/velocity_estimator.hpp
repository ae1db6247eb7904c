// Velocity of a point from its sampled positions.
#pragma once

#include <cmath>
#include <limits>

#include <Eigen/Core>

namespace calligraphy {

/// Backward differences of successive positions, smoothed by a first-order low-pass: the velocity that a device
/// without a tachometer can report. The filter delays the estimate by about 1 / (2 pi cutoff), 3.2 ms at 50 Hz; for
/// positions in steps D sampled at intervals T, the estimate is itself in steps of about 2 pi cutoff D.
///
/// Any coordinates will do (device or page axes, joint angles). Only the constructor may allocate or throw.
class VelocityEstimator {
 public:
  static constexpr double default_cutoff = 50.0;  ///< cut-off frequency of the low-pass where none is given [Hz]

  /// `cutoff`: cut-off frequency of the low-pass [Hz]. @throws ValueError unless it is finite and above 0
  explicit VelocityEstimator(double cutoff = default_cutoff);

  /// Takes the next position [m], sampled `elapsed` [s] after the previous call, and returns the estimate [m/s]. The
  /// first call after construction or restart() gives zero, whatever its `elapsed`. From then on an `elapsed` that is
  /// not above 0 and finite, or a position that is not finite, leaves the estimate unchanged; the next difference is
  /// then taken from the last good position, over the whole time since.
  const Eigen::Vector3d& update(const Eigen::Vector3d& position, double elapsed) noexcept;

  /// The last estimate [m/s].
  const Eigen::Vector3d& velocity() const noexcept { return velocity_; }

  /// Forgets the position and the estimate. Call it after a gap, or when the origin has moved.
  void restart() noexcept;

 private:
  /// Maximum difference between intervals, in the exponent of the low-pass, that counts as jitter of the clock.
  static constexpr double max_jitter = 0.02;

  /// 1 - exp(-x), to 1e-13 for |x| <= max_jitter. Uses Estrin's scheme, because forces wait for the velocity.
  static double rise(double x) noexcept {
    const double square = x * x;
    return (x - 1.0 / 2.0 * square) + x * square * ((1.0 / 6.0 - 1.0 / 24.0 * x) + 1.0 / 120.0 * square);
  }
  /// Relies on zero times infinity or NaN being NaN.
  static bool is_finite(const Eigen::Vector3d& vector) noexcept {
    return 0.0 * vector.x() + 0.0 * vector.y() + 0.0 * vector.z() == 0.0;
  }
  void learn_share() noexcept;

  double cutoff_;  ///< angular [rad/s]
  bool has_position_ = false;
  double since_position_ = 0.0;  ///< [s]
  double share_ = 0.0;           ///< weight of the newest difference in the estimate if its interval is `share_time_`
  double share_time_ = 0.0;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
};

inline const Eigen::Vector3d& VelocityEstimator::update(const Eigen::Vector3d& position, double elapsed) noexcept {
  if (!has_position_) [[unlikely]] {
    if (!is_finite(position)) return velocity_;
    has_position_ = true;
  } else {
    if (!(elapsed > 0.0 && elapsed < std::numeric_limits<double>::infinity())) [[unlikely]] return velocity_;
    since_position_ += elapsed;
    const Eigen::Vector3d difference = (position - position_) * (1.0 / since_position_);
    // The old estimate decays over the interval whose share is known, then over the excess of this interval.
    if (!(std::abs(since_position_ - share_time_) * cutoff_ <= max_jitter)) [[unlikely]] learn_share();
    const double share = share_ + (1.0 - share_) * rise(cutoff_ * (since_position_ - share_time_));
    const Eigen::Vector3d smoothed = velocity_ + share * (difference - velocity_);
    if (is_finite(smoothed)) [[likely]] {
      velocity_ = smoothed;
    } else if (!is_finite(position)) {
      return velocity_;  // otherwise the difference has overflowed
    }
  }
  position_ = position;
  since_position_ = 0.0;
  return velocity_;
}

}  // namespace calligraphy
