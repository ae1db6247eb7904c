// Description of a haptic device: axes, limits and physical properties.
#pragma once

#include <cstdint>
#include <string>

#include <Eigen/Core>

namespace calligraphy {

/// Degrees of freedom of a device.
struct DeviceAxes {
  bool x = true;           ///< translation along this device axis
  bool y = true;           ///< translation along this device axis
  bool z = true;           ///< translation along this device axis
  bool rotations = false;  ///< pen orientation, sensed as altitude, azimuth and twist of DeviceState::stylus

  /// Whether x, y and z are all present, which the renderer and the simulation require.
  bool all_translations() const noexcept { return x && y && z; }
};

/// For example "x, y, z, rotations" or "none".
std::string axes_text(const DeviceAxes& axes);

/// Origin of DeviceState::velocity.
enum class VelocitySource : std::uint8_t {
  measured,  ///< true at the time of the sample, from a tachometer or an ideal device
  estimated  ///< filtered differences of quantised positions, as by a VelocityEstimator: late and in steps
};

/// "measured", "estimated".
const char* to_string(VelocitySource source) noexcept;

/// Limits of a device, and its properties as a point mass, equal along all axes. The simulation, the stiffness bounds
/// and the renderer all use this struct.
struct Capabilities {
  std::string name;        ///< name of the built-in profile; may be empty
  std::string model;       ///< display name: "Phantom Omni"
  bool simulated = false;  ///< nobody can be hurt, so unstable stiffnesses may be tried (StiffnessCheck::off)
  DeviceAxes sensed;       ///< axes that read() measures
  DeviceAxes driven;       ///< axes along which write() exerts a force
  Eigen::Vector3d workspace = Eigen::Vector3d::Zero();  ///< extent along each device axis, centred on zero [m]
  double peak_force = 0.0;                              ///< maximum force; 0: unknown, no limit; a renderer needs it [N]
  double continuous_force = 0.0;                        ///< force that it sustains indefinitely; 0: unknown [N]
  double usable_stiffness = 0.0;                        ///< maximum stiffness reported by users of the device [N/m]
  double force_step = 0.0;    ///< forces are rounded to multiples of it (DAC); 0: unknown, or not quantised [N]
  double encoder_step = 0.0;  ///< positions are rounded to multiples of it; 0: unknown, or not quantised [m]
  VelocitySource velocity = VelocitySource::estimated;  ///< origin of the velocity of a sample
  double velocity_cutoff = 50.0;  ///< cut-off frequency of the filter for an estimated velocity [Hz]
  double update_rate = 1000.0;    ///< rate of the samples and the servo loop [Hz]
  double apparent_mass = 0.0;     ///< at the tip; 0: unknown [kg]
  double viscous_friction = 0.0;  ///< damping of the mechanism itself [N s/m]
  double coulomb_friction = 0.0;  ///< back-drive friction [N]
  int sample_delay = 0;           ///< age of a sample when it is read [ticks]
};

/// The name, or the model if the name is empty; for messages.
const std::string& device_label(const Capabilities& capabilities) noexcept;

/// Zero is valid ("unknown" where a field says so), and forces may be unlimited.
/// @throws ValueError naming the field that is negative or not a number, or an axis that is driven but not sensed; also
/// when no axis is sensed
void validate(const Capabilities& capabilities);

/// The force that the device outputs when a force is commanded, both in device axes [N]: limited in magnitude to the
/// peak force (0: unknown, no limit), then rounded per axis to the nearest force step, or towards zero where that would
/// exceed the peak. A force that is not finite counts as zero.
Eigen::Vector3d output_force(const Capabilities& capabilities, const Eigen::Vector3d& commanded) noexcept;

/// Checks that a device has all three translations. @throws ValueError naming `user` and the axes unless x, y and z are
/// both sensed and driven
void require_translations(const Capabilities& capabilities, const char* user);

}  // namespace calligraphy
