// What a haptic device can do, and its physics: the one description of a device.
#pragma once

#include <string>

#include <Eigen/Core>

namespace calligraphy {

/// Degrees of freedom of a device.
struct DeviceAxes {
  bool x = true, y = true, z = true;  ///< translations, along the device axes
  bool rotations = false;             ///< of the pen: sensed as DeviceState::orientation

  bool all_translations() const noexcept { return x && y && z; }
};

/// "x, y, z, rotations"; "none"
std::string axes_text(const DeviceAxes& axes);

/// What a device can do, and its physics as a point mass, the same along each axis. The simulation, the stiffness
/// advice and the renderer all read it here.
struct Capabilities {
  std::string name;                                     ///< of the shipped profile that it came from; may be empty
  std::string model;                                    ///< for people: "Phantom Omni"
  DeviceAxes sensed;                                    ///< what read() measures
  DeviceAxes driven;                                    ///< where write() exerts a force
  Eigen::Vector3d workspace = Eigen::Vector3d::Zero();  ///< extent along each device axis, centred on zero [m]
  double peak_force = 0.0;                              ///< [N]
  double continuous_force = 0.0;                        ///< [N]
  double usable_stiffness = 0.0;                        ///< largest stiffness that users of the device report [N/m]
  double encoder_step = 0.0;      ///< positions are rounded to multiples of it; 0: not known, or not rounded [m]
  double update_rate = 1000.0;    ///< [Hz]
  double apparent_mass = 0.0;     ///< at the tip; 0: not known [kg]
  double viscous_friction = 0.0;  ///< [N s/m]
  double coulomb_friction = 0.0;  ///< back-drive friction along each axis [N]
  int sample_delay = 0;           ///< age of a sample when it is read [ticks]
};

/// For messages: the name, or else the model.
const std::string& device_label(const Capabilities& capabilities) noexcept;

/// @throws ValueError naming what is negative or not a number (0 may be "not known", and forces may have no limit), an
/// axis that is driven and not sensed, or that no axis is sensed
void validate(const Capabilities& capabilities);

/// @throws ValueError naming `user` and the axes unless x, y and z are sensed and driven
void require_translations(const Capabilities& capabilities, const char* user);

}  // namespace calligraphy
