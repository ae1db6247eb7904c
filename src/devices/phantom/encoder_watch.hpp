// Follows the encoders over their wraps and judges whether an arm can have moved so.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include <calligraphy/devices/device_state.hpp>
#include <calligraphy/devices/phantom/wire_profile.hpp>

namespace calligraphy::phantom {

/// A joint leaps when it turns faster than 60 rad/s (8 m/s at the tip of an Omni), or changes its speed by 20 rad/s
/// from one report to the next (2.7 m/s within a millisecond: neither a hand nor a motor nor a stop does that). A
/// report that leaps is not used, so that one flipped bit of 8 counts or more moves nothing; after five in a row the
/// counts are taken to be lost, and with them the calibration.
///
/// A joint is stuck when another has travelled 2.5 rad (a third of a metre at the tip of an Omni) and it has not
/// changed by a single count. Travel is counted in steps of 0.01 rad, so that the flicker of an encoder adds nothing
/// and a hand that holds still gives no alarm, for however long. No joint can stand still that long under a hand that
/// writes; only the way from the inkwell and a few strokes, drawn by a machine in the plane of the arm, turn the waist
/// as little. That all three joints stand still is a hand that holds still.
class EncoderWatch {
 public:
  struct Answer {
    bool used = true;
    bool lost_count = false;  ///< the angles have begun anew
    DeviceFault fault = DeviceFault::none;
  };

  EncoderWatch(const PerJoint<Field>& fields, const Eigen::Vector3d& counts_per_radian);

  /// `elapsed`: since the last call [s]; `even`: by the device's own count and not by the time of arrival, whose jitter
  /// would look like a change of speed.
  Answer judge(const PerJoint<std::int64_t>& shown, double elapsed, bool even) noexcept;

  /// The next counts are right whatever they are, and the angles begin at zero.
  void restart() noexcept;
  /// Reports were missing for long, but the encoders have gone on counting: the next movement is no leap.
  void interrupt() noexcept;

  /// Turned since the first report [rad].
  Eigen::Vector3d angles() const noexcept;
  /// Mean over the time since the last report that was used [rad/s]; zero when there was none.
  const Eigen::Vector3d& velocity() const noexcept { return velocity_; }
  /// That time [s].
  double interval() const noexcept { return interval_; }

 private:
  bool leaps(const Eigen::Vector3d& velocity, double interval, bool even) const noexcept;
  bool stuck(const Eigen::Vector3d& moved) noexcept;

  PerJoint<int> bits_;
  Eigen::Vector3d counts_per_radian_;
  bool started_ = false;
  bool has_velocity_ = false;
  int leaps_ = 0;  ///< in a row
  PerJoint<std::int64_t> shown_{};
  PerJoint<std::int64_t> total_{};
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  double interval_ = 0.0;
  double since_used_ = 0.0;
  Eigen::Vector3d anchor_ = Eigen::Vector3d::Zero();             ///< where the last step of travel was counted [rad]
  Eigen::Vector3d travel_ = Eigen::Vector3d::Zero();             ///< of each joint [rad]
  Eigen::Matrix3d travel_when_moved_ = Eigen::Matrix3d::Zero();  ///< column j: when joint j moved last [rad]
};

}  // namespace calligraphy::phantom
