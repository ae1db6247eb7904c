// Unwraps encoder counts and checks them for physically impossible motion.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include <calligraphy/devices/device_state.hpp>
#include <calligraphy/devices/phantom/wire_profile.hpp>

namespace calligraphy::phantom {

/// A joint jumps if it turns faster than 60 rad/s (8 m/s at the tip of an Omni), or if its speed changes by 20 rad/s
/// from one report to the next (2.7 m/s within a millisecond, which no hand, motor or end stop causes). A report with a
/// jump is not used, so a single flipped bit of 64 counts or more (of 2425 per radian) has no effect. After five in a
/// row the counts, and with them the calibration, are considered lost.
///
/// A joint is stuck if it has not changed by a single count while another travelled 2.5 rad (a third of a metre at the
/// tip of an Omni). Travel is counted in steps of 0.01 rad, so encoder flicker adds nothing and a still hand never
/// raises an alarm. No joint stays still for that long while a person writes; only the path from the inkwell and a few
/// strokes drawn by a machine in the plane of the arm turn the waist so little. If all three joints are stationary, the
/// hand is considered still.
class EncoderWatch {
 public:
  struct Result {
    bool used = true;
    bool lost_count = false;  ///< the angles have restarted from zero
    DeviceFault fault = DeviceFault::none;
  };

  EncoderWatch(const PerJoint<Field>& fields, const Eigen::Vector3d& counts_per_radian);

  /// `elapsed`: time since the last call [s]. `even`: the time comes from the device's sequence number, not from the
  /// arrival time, whose jitter would look like a change of speed.
  Result check(const PerJoint<std::int64_t>& shown, double elapsed, bool even) noexcept;

  /// Accepts any counts next; the angles restart from zero.
  void restart() noexcept;
  /// Reports were missing for a long time, but the encoders kept counting: the next change is not a jump.
  void interrupt() noexcept;

  /// Angles turned since the first report [rad].
  Eigen::Vector3d angles() const noexcept;
  /// Mean velocity since the last used report [rad/s]; zero if there was none.
  const Eigen::Vector3d& velocity() const noexcept { return velocity_; }
  /// Time over which velocity() is averaged [s].
  double interval() const noexcept { return interval_; }

 private:
  bool leaps(const Eigen::Vector3d& velocity, double interval, bool even) const noexcept;
  bool stuck(const Eigen::Vector3d& moved) noexcept;

  PerJoint<int> bits_;
  Eigen::Vector3d counts_per_radian_;
  bool started_ = false;
  bool has_velocity_ = false;
  int leaps_ = 0;  ///< consecutive
  PerJoint<std::int64_t> shown_{};
  PerJoint<std::int64_t> total_{};
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  double interval_ = 0.0;
  double since_used_ = 0.0;
  Eigen::Vector3d anchor_ = Eigen::Vector3d::Zero();             ///< angles at the last counted step of travel [rad]
  Eigen::Vector3d travel_ = Eigen::Vector3d::Zero();             ///< of each joint [rad]
  Eigen::Matrix3d travel_when_moved_ = Eigen::Matrix3d::Zero();  ///< column j: travel when joint j last moved [rad]
};

}  // namespace calligraphy::phantom
