// What a haptic device says of itself and of the hand: plain structs, in the device's own axes.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

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

/// One sample of the device.
struct DeviceState {
  double time = 0.0;                                   ///< since the device was opened [s]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< haptic interface point, device axes [m]
  Eigen::Vector3d velocity =                           ///< [m/s]; NaN when the device does not measure it
      Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  std::uint32_t buttons = 0;  ///< one bit per button
  DeviceStatus status = DeviceStatus::ok;
};

/// What a device can do.
struct Capabilities {
  std::string model;
  Eigen::Vector3d workspace = Eigen::Vector3d::Zero();  ///< extent along each device axis, centred on zero [m]
  double peak_force = 0.0;                              ///< [N]
  double continuous_force = 0.0;                        ///< [N]
  double usable_stiffness = 0.0;                        ///< largest stiffness that users of the device report [N/m]
  double resolution = 0.0;                              ///< position step; 0: not known [m]
  double update_rate = 1000.0;                          ///< [Hz]
  double apparent_mass = 0.0;                           ///< at the tip; 0: not known [kg]
  double viscous_friction = 0.0;                        ///< [N s/m]
  double coulomb_friction = 0.0;                        ///< back-drive friction along each axis [N]
  int sample_delay = 0;                                 ///< age of a sample when it is read [ticks]
};

/// Impedance of the grip, relative to where the person means to be, the same along each axis. Typical grips: soft
/// (0.05, 1, 100), normal (0.1, 3, 300), firm (0.15, 5, 500).
struct Hand {
  double mass = 0.1;         ///< [kg]
  double damping = 3.0;      ///< [N s/m]
  double stiffness = 300.0;  ///< [N/m]
};

}  // namespace calligraphy
