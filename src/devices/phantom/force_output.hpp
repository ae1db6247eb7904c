// Converts a force at the tip to motor counts: force limit, thermal limit, rounding.
#pragma once

#include <atomic>

#include <Eigen/Core>

#include <calligraphy/devices/device_state.hpp>
#include <calligraphy/devices/phantom/kinematics.hpp>
#include <calligraphy/devices/phantom/phantom_device.hpp>

#include "devices/phantom/wire/packet_codec.hpp"
#include "motor_temperature.hpp"

namespace calligraphy::phantom {

class ForceOutput {
 public:
  /// The linkage must outlive this. Without a continuous torque in the profile, the motors are assumed to sustain the
  /// model's continuous force along any axis at the centre of the workspace.
  ForceOutput(const PacketCodec& codec, const Linkage& linkage, const Capabilities& capabilities,
              const PhantomOptions& options);

  /// Limits the magnitude to the peak force; zero if the force is not finite.
  Eigen::Vector3d shortened(const Eigen::Vector3d& force) const noexcept;

  /// Advances the thermal model by the time for which the motors have held the last command [s].
  void pass_time(double seconds) noexcept;

  /// Torques for the force, scaled as a whole to what every DAC can output and every motor can sustain, so that the
  /// direction is preserved. `gain` scales the gravity compensation; 0 switches the motors off.
  RawCommand command(const Joints& joints, const Eigen::Vector3d& force, double gain) noexcept;

  /// The force at the tip from the last command, after these limits, before rounding to counts [N].
  const Eigen::Vector3d& force() const noexcept { return force_; }

  double warmest() const noexcept { return temperature_.warmest(); }
  /// Whether a motor has reached 1 and is not yet below `warm` again. Always false with `limit_heat`.
  bool overheated() const noexcept { return overheated_; }
  /// The value of warmest(), thread-safe.
  double published_warmest() const noexcept { return published_warmest_.load(std::memory_order_relaxed); }

 private:
  const Linkage& linkage_;
  double peak_force_;  ///< [N]
  bool limit_heat_;
  Eigen::Vector2d gravity_ = Eigen::Vector2d::Zero();           ///< [N m]
  Eigen::Vector3d torque_per_count_ = Eigen::Vector3d::Ones();  ///< [N m]
  Eigen::Vector3d counts_;                                      ///< range of each DAC in both directions
  MotorTemperature temperature_;
  Eigen::Vector3d held_ = Eigen::Vector3d::Zero();  ///< torque of the last command [N m]
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
  bool overheated_ = false;
  std::atomic<double> published_warmest_ = 0.0;
};

}  // namespace calligraphy::phantom
