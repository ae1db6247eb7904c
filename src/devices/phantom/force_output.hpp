// From a force at the tip to the counts of the motors: clamp, heat, rounding.
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
  /// The linkage must outlive this. A profile that says nothing of continuous torque is taken to bear, at the middle of
  /// the workspace, the continuous force of the model along every axis.
  ForceOutput(const PacketCodec& codec, const Linkage& linkage, const Capabilities& capabilities,
              const PhantomOptions& options);

  /// No longer than the peak force; zero when it is not finite.
  Eigen::Vector3d shortened(const Eigen::Vector3d& force) const noexcept;

  /// The motors have held the last command for so long [s].
  void pass_time(double seconds) noexcept;

  /// Torque for the force, shortened in one piece to what every DAC can give and every motor can bear, so that its
  /// direction stays. `gain` 0 is no force at all: motors off; it is the share of the weight that is borne, too.
  RawCommand command(const Joints& joints, const Eigen::Vector3d& force, double gain) noexcept;

  double warmest() const noexcept { return temperature_.warmest(); }
  /// Only without `limit_heat`: a motor got to 1 and is not below `warm` again.
  bool overheated() const noexcept { return overheated_; }
  /// warmest(), for any thread.
  double published_warmest() const noexcept { return published_warmest_.load(std::memory_order_relaxed); }

 private:
  const Linkage& linkage_;
  double peak_force_;  ///< [N]
  bool limit_heat_;
  Eigen::Vector2d gravity_ = Eigen::Vector2d::Zero();           ///< [N m]
  Eigen::Vector3d torque_per_count_ = Eigen::Vector3d::Ones();  ///< [N m]
  Eigen::Vector3d counts_;                                      ///< that each DAC can give both ways
  MotorTemperature temperature_;
  Eigen::Vector3d held_ = Eigen::Vector3d::Zero();  ///< torque of the last command [N m]
  bool overheated_ = false;
  std::atomic<double> published_warmest_ = 0.0;
};

}  // namespace calligraphy::phantom
