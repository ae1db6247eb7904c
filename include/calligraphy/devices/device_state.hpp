// What a haptic device says: plain structs, in the device's own axes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include <Eigen/Core>

namespace calligraphy {

/// How a sample may be trusted.
enum class DeviceStatus : std::uint8_t {
  ok,                 ///< a fresh sample
  stale,              ///< the last sample again: nothing new has arrived
  disconnected,       ///< the device is gone, or a recorded trace has ended
  warm_motors,        ///< the device limits its force to protect its motors
  needs_calibration,  ///< positions are not absolute yet
  fault               ///< the device reports an error of its own
};

/// "ok", "needs calibration": the status in words.
const char* status_name(DeviceStatus status) noexcept;

/// What is wrong with a device, its link or its loop. Several are seen by the link alone, others by the codec, the
/// device or the servo loop; all of them are told by name.
enum class DeviceFault : std::uint8_t {
  none,
  unplugged,          ///< gone from the bus
  stalled,            ///< an endpoint refuses transfers
  timed_out,          ///< a transfer was not answered in time
  link_error,         ///< any other failure of a transfer
  empty_frame,        ///< a transfer without a byte
  short_frame,        ///< fewer bytes than the profile says
  overlong_frame,     ///< more bytes than the profile says
  corrupted_frame,    ///< redundant fields disagree, or a value that cannot be
  lost_frames,        ///< the sequence number leapt
  repeated_frames,    ///< the sequence number stands still or runs back
  stuck_encoder,      ///< one joint stands while others move
  leaping_encoder,    ///< a joint moved faster than it can
  outside_workspace,  ///< joints at angles that the linkage cannot take
  silent,             ///< no fresh sample for longer than the servo loop allows
  overheated,         ///< motors too warm to go on
  runtime_error,      ///< the vendor's runtime reports an error
  slow_force_law,     ///< the callable took longer than the watchdog allows
  bad_force,          ///< the callable gave a force that is not finite
  late_clock,         ///< the loop was not run for longer than the watchdog allows
  uncalibrated,       ///< positions are not absolute yet
  device_error        ///< the device says that it cannot go on, and gives no reason
};

inline constexpr std::size_t device_fault_count = static_cast<std::size_t>(DeviceFault::device_error) + 1;

/// "unplugged", "short frame": the name in words.
const char* fault_name(DeviceFault fault) noexcept;

/// Where the pen points, in device axes: the direction from its tip to its other end is
/// (sin tilt cos azimuth, sin tilt sin azimuth, cos tilt). NaN when the device does not measure it.
///
/// Of W3C Pointer Events (Level 3) where a screen lies in the x-y plane and faces z: tilt = pi / 2 - altitudeAngle,
/// azimuth = -azimuthAngle, since the y axis of a screen points down.
struct PenOrientation {
  double tilt = std::numeric_limits<double>::quiet_NaN();     ///< from the z axis, 0 to pi [rad]
  double azimuth = std::numeric_limits<double>::quiet_NaN();  ///< from the x axis towards the y axis, -pi to pi [rad]
};

/// One sample of the device.
struct DeviceState {
  double time = 0.0;                                   ///< since the device was opened [s]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< haptic interface point, device axes [m]
  Eigen::Vector3d velocity =                           ///< [m/s]; NaN when the device does not measure it
      Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  std::uint32_t buttons = 0;  ///< one bit per button
  DeviceStatus status = DeviceStatus::ok;
  DeviceFault fault = DeviceFault::none;  ///< the reason when the status is not ok, where one is known
  PenOrientation orientation;
};

/// Impedance of the grip, relative to where the person means to be, the same along each axis. Typical grips: soft
/// (0.05, 1, 100), normal (0.1, 3, 300), firm (0.15, 5, 500).
struct Hand {
  double mass = 0.1;         ///< [kg]
  double damping = 3.0;      ///< [N s/m]
  double stiffness = 300.0;  ///< [N/m]
};

}  // namespace calligraphy
