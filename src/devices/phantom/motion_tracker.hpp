// From decoded reports to where the tip is: sequence, encoders, calibration, kinematics, velocity.
#pragma once

#include <Eigen/Core>

#include <calligraphy/devices/phantom/kinematics.hpp>
#include <calligraphy/devices/phantom/wire_profile.hpp>

#include "devices/phantom/wire/packet_codec.hpp"
#include "encoder_watch.hpp"
#include "sequence_watch.hpp"

namespace calligraphy::phantom {

/// Where the arm is.
struct Motion {
  double time = 0.0;                                   ///< of arrival [s]
  Joints joints = Joints::Zero();                      ///< [rad]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< device axes [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< device axes [m/s]
  std::uint32_t buttons = 0;
  bool docked = false;
  bool calibrated = false;
};

/// Takes reports one by one. Not calibrated until the pen has stood in the inkwell for 20 reports; until then the first
/// report is taken for one from the inkwell, so that motions can be seen.
class MotionTracker {
 public:
  struct Judgement {
    bool fresh = false;  ///< motion() is new
    DeviceFault fault = DeviceFault::none;
    std::uint64_t lost = 0;  ///< reports missing before this one
    bool repeated = false;
  };

  /// `velocity_cutoff`: of the first-order filter [Hz]. The profile has what a position needs.
  MotionTracker(const WireProfile& profile, const Linkage& linkage, double velocity_cutoff);

  Judgement take(const RawSample& sample, double now) noexcept;
  const Motion& motion() const noexcept { return motion_; }

  /// The link was interrupted. The encoders are relative: unless they are known to go on counting, they begin anew.
  void restart(bool keep_calibration) noexcept;
  /// The joints are at these angles now.
  void calibrate(const Joints& joints) noexcept;

 private:
  void follow_docking(bool docked) noexcept;

  const Linkage& linkage_;
  Joints docked_angles_;
  double period_;  ///< [s]
  double velocity_cutoff_;
  bool has_sequence_;
  SequenceWatch sequence_;
  EncoderWatch encoders_;
  Joints offset_;  ///< of the joints where the encoders began [rad]
  Eigen::Vector3d joint_velocity_ = Eigen::Vector3d::Zero();
  double last_time_ = 0.0;
  int docked_for_ = 0;  ///< reports, at rest
  Joints docked_at_ = Joints::Zero();
  Motion motion_;
};

}  // namespace calligraphy::phantom
