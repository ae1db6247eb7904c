// Where each figure comes from, and how good that source is, stands in docs/devices.md. Apparent mass, viscous friction
// and, but for the Omni, Coulomb friction are estimates.
#include <array>
#include <limits>

#include <calligraphy/devices/simulated_device.hpp>
#include <calligraphy/error.hpp>

namespace calligraphy {
namespace {

/// Peak force and usable stiffness: what CHAI3D's CPhantomDevices.cpp allows. The rest: secondary tables.
Capabilities capabilities(const char* model, const Eigen::Vector3d& workspace, double peak, double continuous,
                          double stiffness, double resolution) {
  Capabilities result;
  result.model = model;
  result.workspace = workspace;
  result.peak_force = peak;
  result.continuous_force = continuous;
  result.usable_stiffness = stiffness;
  result.resolution = resolution;
  return result;
}

/// Estimate for every real device: the low end of what is plausible, so that the simulation flatters no controller.
constexpr double viscous_friction = 0.1;

DeviceProfile physical(const char* name, Capabilities capabilities, double mass, double coulomb_friction) {
  DeviceProfile profile;
  profile.name = name;
  profile.mass = mass;
  profile.viscous_friction = viscous_friction;
  profile.coulomb_friction = coulomb_friction;
  profile.encoder_step = capabilities.resolution;
  profile.capabilities = std::move(capabilities);
  profile.capabilities.apparent_mass = mass;
  profile.capabilities.viscous_friction = viscous_friction;
  profile.capabilities.coulomb_friction = coulomb_friction;
  return profile;
}

DeviceProfile ideal() {
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  DeviceProfile profile;
  profile.name = "ideal";
  profile.mass = 0.045;
  profile.capabilities = capabilities("Ideal point mass", {0.160, 0.120, 0.070}, unlimited, unlimited, unlimited, 0.0);
  profile.capabilities.apparent_mass = profile.mass;
  return profile;
}

std::array<DeviceProfile, 5> make_profiles() {
  return {
      physical("omni", capabilities("Phantom Omni", {0.160, 0.120, 0.070}, 3.3, 0.88, 700.0, 55e-6), 0.045, 0.26),
      physical("touch", capabilities("Touch", {0.160, 0.120, 0.070}, 3.3, 0.88, 400.0, 55e-6), 0.045, 0.26),
      physical("desktop", capabilities("Phantom Desktop", {0.160, 0.120, 0.120}, 7.9, 1.75, 1000.0, 23e-6), 0.045,
               0.06),
      physical("premium-1.5", capabilities("Phantom Premium 1.5", {0.381, 0.267, 0.191}, 8.5, 1.4, 800.0, 30e-6), 0.075,
               0.04),
      ideal(),
  };
}

}  // namespace

std::span<const DeviceProfile> device_profiles() {
  static const std::array<DeviceProfile, 5> profiles = make_profiles();
  return profiles;
}

const DeviceProfile& device_profile(std::string_view name) {
  std::string known;
  for (const DeviceProfile& profile : device_profiles()) {
    if (profile.name == name) return profile;
    known += (known.empty() ? "" : ", ") + profile.name;
  }
  throw ValueError("device profile \"" + std::string(name) + "\" does not exist; there are " + known);
}

}  // namespace calligraphy
