// How warm the motors are, as far as the torque tells.
#pragma once

#include <Eigen/Core>

namespace calligraphy::phantom {

/// Winding and housing of each motor as two lags in series with the heat, which grows with the square of the torque.
/// The temperatures have no unit: 0 is a cold motor, 1 one that has borne its continuous torque for ever. Time
/// constants and their shares are those of the Premium's motors [mahilab/Phantom: winding 12 s and 3.1 K/W, motor 612 s
/// and 14 K/W]; for other models they are an assumption.
class MotorTemperature {
 public:
  /// From this on a motor counts as warm.
  static constexpr double warm = 0.8;

  /// What each motor bears for ever, and the most that it will be asked for [N m]; above 0.
  MotorTemperature(const Eigen::Vector3d& continuous, const Eigen::Vector3d& peak);

  /// Lets time pass under a torque that is held; exact for any time.
  void advance(const Eigen::Vector3d& torque, double seconds) noexcept;

  /// Of the warmest motor.
  double warmest() const noexcept { return of_motors().maxCoeff(); }
  Eigen::Vector3d of_motors() const noexcept;

  /// The share of this torque that no motor is too warm for, 0 to 1: all of it below `warm`; from there the heat that
  /// is allowed falls from that of the peak to none at 1. So a motor never gets to 1, and what may be held for ever is
  /// the continuous torque to within 1 %.
  double allowed_share(const Eigen::Vector3d& torque) const noexcept;

 private:
  Eigen::Vector3d continuous_;
  Eigen::Vector3d peak_;
  Eigen::Vector3d winding_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d housing_ = Eigen::Vector3d::Zero();
};

}  // namespace calligraphy::phantom
