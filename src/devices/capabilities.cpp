#include <calligraphy/devices/capabilities.hpp>

#include <cmath>

#include <calligraphy/base/error.hpp>

#include "base/enum_name.hpp"
#include "base/require.hpp"

namespace calligraphy {
namespace {

/// Prefix of error messages.
std::string device_text(const Capabilities& capabilities) { return "device \"" + device_label(capabilities) + "\": "; }

/// Limits the magnitude. Scales by the largest component first, so that no square overflows.
Eigen::Vector3d shortened(const Eigen::Vector3d& force, double limit) noexcept {
  const double largest = force.cwiseAbs().maxCoeff();
  if (largest == 0.0) return force;
  const Eigen::Vector3d scaled = force / largest;
  const double length = scaled.norm();
  if (largest * length <= limit) return force;
  return scaled * (limit / length);
}

}  // namespace

const char* to_string(VelocitySource source) noexcept {
  static constexpr const char* names[] = {"measured", "estimated"};
  return name_of<VelocitySource::estimated>(source, names, "unknown");
}

std::string axes_text(const DeviceAxes& axes) {
  std::string text;
  const auto add = [&text](bool has, const char* name) {
    if (has) text += (text.empty() ? "" : ", ") + std::string(name);
  };
  add(axes.x, "x");
  add(axes.y, "y");
  add(axes.z, "z");
  add(axes.rotations, "rotations");
  return text.empty() ? "none" : text;
}

const std::string& device_label(const Capabilities& capabilities) noexcept {
  return capabilities.name.empty() ? capabilities.model : capabilities.name;
}

void validate(const Capabilities& capabilities) {
  const std::string device = device_text(capabilities);
  const auto may_be_infinite = [&device](const char* name, double value, const char* unit) {
    require(value >= 0.0, device + name, value, unit, "at least 0");
  };
  for (const double extent : capabilities.workspace) {
    require_within(device + "workspace", extent, "m", 0.0, 20.0, "it is in metres");
  }
  may_be_infinite("peak force", capabilities.peak_force, "N");
  may_be_infinite("continuous force", capabilities.continuous_force, "N");
  may_be_infinite("usable stiffness", capabilities.usable_stiffness, "N/m");
  require_not_negative(device + "force step", capabilities.force_step, "N");
  const double peak = capabilities.peak_force;
  require(peak == 0.0 || capabilities.force_step <= peak, device + "force step", capabilities.force_step, "N",
          "at most the peak force: a larger one would round every force to zero");
  require_within(device + "encoder step", capabilities.encoder_step, "m", 0.0, 0.005, "it is in metres");
  require_within(device + "velocity cut-off", capabilities.velocity_cutoff, "Hz", 1.0, 1e6,
                 "a slower filter has no velocity of a stroke");
  require_not_negative(device + "update rate", capabilities.update_rate, "Hz");
  require_within(device + "apparent mass", capabilities.apparent_mass, "kg", 0.0, 20.0, "it is in kilograms");
  require_not_negative(device + "viscous friction", capabilities.viscous_friction, "N s/m");
  require_within(device + "Coulomb friction", capabilities.coulomb_friction, "N", 0.0, 1000.0, "it is in newtons");
  require_not_negative(device + "sample delay", capabilities.sample_delay, "ticks");

  const DeviceAxes& sensed = capabilities.sensed;
  const DeviceAxes& driven = capabilities.driven;
  if (!(sensed.x || sensed.y || sensed.z || sensed.rotations)) {
    throw ValueError(device + "no axis is sensed, at least one must be");
  }
  const DeviceAxes blind{driven.x && !sensed.x, driven.y && !sensed.y, driven.z && !sensed.z,
                         driven.rotations && !sensed.rotations};
  if (blind.x || blind.y || blind.z || blind.rotations) {
    throw ValueError(device + "driven axes are " + axes_text(driven) + ", sensed axes are " + axes_text(sensed) +
                     "; driven but not sensed: " + axes_text(blind));
  }
}

Eigen::Vector3d output_force(const Capabilities& capabilities, const Eigen::Vector3d& commanded) noexcept {
  if (!commanded.allFinite()) return Eigen::Vector3d::Zero();
  const double peak = capabilities.peak_force, step = capabilities.force_step;
  const Eigen::Vector3d limited = peak > 0.0 ? shortened(commanded, peak) : commanded;
  if (!(step > 0.0)) return limited;
  const Eigen::Vector3d rounded = step * (limited / step).array().round();
  if (!(peak > 0.0 && rounded.stableNorm() > peak)) return rounded;
  return step * (limited / step).unaryExpr([](double steps) { return std::trunc(steps); });
}

void require_translations(const Capabilities& capabilities, const char* user) {
  if (capabilities.sensed.all_translations() && capabilities.driven.all_translations()) return;
  throw ValueError(device_text(capabilities) + "sensed axes are " + axes_text(capabilities.sensed) +
                   ", driven axes are " + axes_text(capabilities.driven) + "; " + user +
                   " needs x, y and z to be sensed and driven");
}

}  // namespace calligraphy
