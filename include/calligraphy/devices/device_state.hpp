// State of a haptic device, as plain structs in device axes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include <Eigen/Core>

#include <calligraphy/base/stylus_state.hpp>

namespace calligraphy {

/// Validity of a sample.
enum class DeviceStatus : std::uint8_t {
  ok,                 ///< a fresh sample
  stale,              ///< the previous sample again: no new one has arrived
  disconnected,       ///< the device is gone, or the recording has ended
  warm_motors,        ///< the device limits its force to protect its motors
  needs_calibration,  ///< positions are not yet absolute
  fault               ///< the device cannot continue
};

/// Display text: "ok", "needs calibration".
const char* to_string(DeviceStatus status) noexcept;

/// What the user has to do about it: "needs calibration: put the pen ..."; empty if nothing.
const char* advice_text(DeviceStatus status) noexcept;

/// Cause of a fault in a device, its link or its servo loop. Some are detected by the link, others by the codec, the
/// device or the servo loop.
enum class DeviceFault : std::uint8_t {
  none,               ///< no fault, or a cause that is not known
  unplugged,          ///< no longer on the bus
  stalled,            ///< an endpoint refuses transfers
  timed_out,          ///< a transfer, or a call of the device, did not complete in time
  link_error,         ///< a transfer failed in any other way
  empty_frame,        ///< a transfer without any bytes
  short_frame,        ///< fewer bytes than the profile specifies
  overlong_frame,     ///< more bytes than the profile specifies
  corrupted_frame,    ///< redundant fields disagree, or a value is impossible
  lost_frames,        ///< gap in the sequence numbers
  repeated_frames,    ///< the sequence number repeats or runs backwards
  stuck_encoder,      ///< one joint is stationary while others move
  leaping_encoder,    ///< a joint moved faster than physically possible
  outside_workspace,  ///< joint angles that the linkage cannot reach
  silent,             ///< no fresh sample within the timeout
  overheated,         ///< motors too warm to continue
  runtime_error,      ///< the vendor's runtime reports an error
  slow_force_law,     ///< the force law took longer than the timeout
  bad_force,          ///< the force law threw or returned a force that is not finite
  late_clock,         ///< no tick within the timeout
  emergency_stop,     ///< emergency_stop() was called
  uncalibrated,       ///< positions are not yet absolute
  device_error        ///< the device cannot continue and gives no reason
};

/// Number of values of DeviceFault, for arrays indexed by it.
inline constexpr std::size_t device_fault_count = static_cast<std::size_t>(DeviceFault::device_error) + 1;

/// Display text: "unplugged", "short frame".
const char* to_string(DeviceFault fault) noexcept;

/// One sample of a device.
struct DeviceState {
  double time = 0.0;                                   ///< since the device was opened [s]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< haptic interface point, device axes [m]
  /// Velocity of the haptic interface point, device axes [m/s]; NaN only if the device neither measures nor estimates
  /// it. A force law never sees NaN: Servo estimates the velocity.
  Eigen::Vector3d velocity = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  bool velocity_estimated = false;  ///< from positions, by a VelocityEstimator or the vendor's filter: late and noisy
  /// The force at work when the sample is read, device axes [N]: the last one written, after every limit, guard and
  /// ramp. NaN if the device does not report it; Servo then fills in the force it wrote.
  Eigen::Vector3d force = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  /// How long a force other than `force` may have been at work after the last sample passed to the force law [s].
  /// Filled in by Servo; also 0 if unknown.
  double force_settling = 0.0;
  std::uint32_t buttons = 0;               ///< one bit per button
  DeviceStatus status = DeviceStatus::ok;  ///< whether the sample is fresh and valid
  DeviceFault fault = DeviceFault::none;   ///< the cause of a status other than ok, if known
  StylusState stylus = {};                 ///< what its pen senses besides, in device axes
};

/// Impedance of the grip about the intended position, equal along all axes. Typical grips: soft (0.05, 1, 100), normal
/// (0.1, 3, 300), firm (0.15, 5, 500).
struct GripImpedance {
  double mass = 0.1;         ///< mass that moves with the device [kg]
  double damping = 3.0;      ///< damping of motion relative to the intended one [N s/m]
  double stiffness = 300.0;  ///< stiffness of the spring towards the intended position [N/m]
};

}  // namespace calligraphy
