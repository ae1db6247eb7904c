// docs/devices.md gives the source of each value and its quality. Apparent mass, viscous friction and, except for the
// Omni, Coulomb friction are estimates.
#include <calligraphy/devices/device_profiles.hpp>

#include <array>
#include <limits>

#include <calligraphy/base/error.hpp>

namespace calligraphy {
namespace {

/// Peak force and usable stiffness are the limits in CHAI3D's CPhantomDevices.cpp, the rest is from secondary tables.
Capabilities profile(const char* name, const char* model, const Eigen::Vector3d& workspace, double peak,
                     double continuous, double stiffness) {
  Capabilities result;
  result.name = name;
  result.model = model;
  result.simulated = true;
  result.workspace = workspace;
  result.peak_force = peak;
  result.continuous_force = continuous;
  result.usable_stiffness = stiffness;
  return result;
}

Capabilities physical(Capabilities profile, double encoder_step, double mass, double coulomb_friction) {
  profile.encoder_step = encoder_step;
  // As the Phantom backend has it.
  profile.velocity = VelocitySource::estimated;
  // The Omni's packets and the PCI card have 12 bits for both directions. That full scale is the peak force is an
  // estimate.
  profile.force_step = profile.peak_force / 2047.0;
  profile.apparent_mass = mass;
  // An estimate for every real device, at the low end of the plausible range, so that the simulation favours no
  // controller.
  profile.viscous_friction = 0.1;
  profile.coulomb_friction = coulomb_friction;
  return profile;
}

std::array<Capabilities, 5> make_profiles() {
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  Capabilities ideal = profile("ideal", "Ideal point mass", {0.160, 0.120, 0.070}, unlimited, unlimited, unlimited);
  ideal.apparent_mass = 0.045;
  ideal.velocity = VelocitySource::measured;
  return {
      physical(profile("omni", "Phantom Omni", {0.160, 0.120, 0.070}, 3.3, 0.88, 700.0), 55e-6, 0.045, 0.26),
      physical(profile("touch", "Touch", {0.160, 0.120, 0.070}, 3.3, 0.88, 400.0), 55e-6, 0.045, 0.26),
      physical(profile("desktop", "Phantom Desktop", {0.160, 0.120, 0.120}, 7.9, 1.75, 1000.0), 23e-6, 0.045, 0.06),
      physical(profile("premium-1.5", "Phantom Premium 1.5", {0.381, 0.267, 0.191}, 8.5, 1.4, 800.0), 30e-6, 0.075,
               0.04),
      ideal,
  };
}

}  // namespace

std::span<const Capabilities> device_profiles() {
  static const std::array<Capabilities, 5> profiles = make_profiles();
  return profiles;
}

const Capabilities& device_profile(std::string_view name) {
  std::string known;
  for (const Capabilities& profile : device_profiles()) {
    if (profile.name == name) return profile;
    known += (known.empty() ? "" : ", ") + profile.name;
  }
  throw ValueError("device profile \"" + std::string(name) + "\" does not exist; available: " + known);
}

}  // namespace calligraphy
