// Thermal model of the motors, driven by the commanded torque.
#pragma once

#include <Eigen/Core>

namespace calligraphy::phantom {

/// Winding and housing of each motor as two first-order lags of the heat, which is proportional to the square of the
/// torque. Temperatures are dimensionless: 0 is a cold motor, 1 the equilibrium at its continuous torque. Time
/// constants and their shares are those of the Premium's motors [mahilab/Phantom: winding 12 s and 3.1 K/W, motor 612 s
/// and 14 K/W]; for other models they are an assumption.
class MotorTemperature {
 public:
  /// Temperature from which a motor counts as warm.
  static constexpr double warm = 0.8;

  /// `continuous`: torque that each motor sustains indefinitely; `peak`: maximum that will be commanded. Above 0 [N m].
  MotorTemperature(const Eigen::Vector3d& continuous, const Eigen::Vector3d& peak);

  /// Advances time under a constant torque; exact for any step.
  void advance(const Eigen::Vector3d& torque, double seconds) noexcept;

  /// Temperature of the warmest motor.
  double warmest() const noexcept { return of_motors().maxCoeff(); }
  Eigen::Vector3d of_motors() const noexcept;

  /// Fraction of this torque that all motors may exert, 0 to 1. Below `warm` it is 1; from there the permitted heat
  /// decreases linearly from that of the peak torque to none at temperature 1. A motor therefore never reaches 1, and
  /// the torque that can be held indefinitely is the continuous torque to within 1 %.
  double allowed_share(const Eigen::Vector3d& torque) const noexcept;

 private:
  Eigen::Vector3d continuous_;
  Eigen::Vector3d peak_;
  Eigen::Vector3d winding_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d housing_ = Eigen::Vector3d::Zero();
};

}  // namespace calligraphy::phantom
