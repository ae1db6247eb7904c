// Computes the motion of the tip from decoded reports: sequence, encoders, calibration, kinematics, velocity.
#pragma once

#include <Eigen/Core>

#include <calligraphy/devices/phantom/kinematics.hpp>
#include <calligraphy/devices/phantom/wire_profile.hpp>
#include <calligraphy/devices/velocity_estimator.hpp>

#include "devices/phantom/wire/packet_codec.hpp"
#include "encoder_watch.hpp"
#include "sequence_watch.hpp"

namespace calligraphy::phantom {

/// State of the arm.
struct Motion {
  double time = 0.0;                                   ///< time of arrival [s]
  Joints joints = Joints::Zero();                      ///< [rad]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< device axes [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< device axes [m/s]
  std::uint32_t buttons = 0;
  bool docked = false;
  bool calibrated = false;
};

/// Processes reports one by one. Calibrated once the pen has been at rest in the inkwell for 20 reports; until then the
/// first report is assumed to come from the inkwell, so that relative motion is visible.
class MotionTracker {
 public:
  struct Result {
    bool fresh = false;  ///< motion() is new
    DeviceFault fault = DeviceFault::none;
    std::uint64_t lost = 0;  ///< reports missing before this one
    bool repeated = false;
  };

  /// `velocity_cutoff`: cut-off frequency of the first-order filter [Hz]. missing_for_position() of the profile must be
  /// empty.
  MotionTracker(const WireProfile& profile, const Linkage& linkage, double velocity_cutoff);

  Result take(const RawSample& sample, double now) noexcept;
  const Motion& motion() const noexcept { return motion_; }

  /// Starts anew after an interruption of the link. Calibration is lost unless the incremental encoders are known to
  /// have kept counting.
  void restart(bool keep_calibration) noexcept;
  /// Sets the current joint angles [rad].
  void calibrate(const Joints& joints) noexcept;

 private:
  void follow_docking(bool docked) noexcept;

  const Linkage& linkage_;
  Joints docked_angles_;
  double period_;  ///< [s]
  bool has_sequence_;
  SequenceWatch sequence_;
  EncoderWatch encoders_;
  VelocityEstimator joint_velocity_;  ///< [rad/s]
  Joints offset_;                     ///< joint angles at zero encoder counts [rad]
  double last_time_ = 0.0;
  int docked_for_ = 0;  ///< consecutive reports at rest
  Joints docked_at_ = Joints::Zero();
  Motion motion_;
};

}  // namespace calligraphy::phantom
