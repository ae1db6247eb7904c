#include <calligraphy/devices/capabilities.hpp>

#include <cmath>
#include <sstream>

#include <calligraphy/base/error.hpp>

namespace calligraphy {
namespace {

/// How messages begin.
std::string device_text(const Capabilities& capabilities) { return "device \"" + device_label(capabilities) + "\": "; }

}  // namespace

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
  const auto check = [&capabilities](const char* name, double value, bool may_be_infinite = false) {
    if (value >= 0.0 && (may_be_infinite || std::isfinite(value))) return;
    std::ostringstream message;
    message << device_text(capabilities) << name << " is " << value << ", must be at least 0"
            << (may_be_infinite ? "" : " and finite");
    throw ValueError(message.str());
  };
  for (const double extent : capabilities.workspace) check("workspace", extent);
  check("peak force", capabilities.peak_force, true);
  check("continuous force", capabilities.continuous_force, true);
  check("usable stiffness", capabilities.usable_stiffness, true);
  check("encoder step", capabilities.encoder_step);
  check("update rate", capabilities.update_rate);
  check("apparent mass", capabilities.apparent_mass);
  check("viscous friction", capabilities.viscous_friction);
  check("Coulomb friction", capabilities.coulomb_friction);
  check("sample delay", capabilities.sample_delay);

  const DeviceAxes& sensed = capabilities.sensed;
  const DeviceAxes& driven = capabilities.driven;
  if (!(sensed.x || sensed.y || sensed.z || sensed.rotations)) {
    throw ValueError(device_text(capabilities) + "sensed axes are none, must be at least one");
  }
  const DeviceAxes blind{driven.x && !sensed.x, driven.y && !sensed.y, driven.z && !sensed.z,
                         driven.rotations && !sensed.rotations};
  if (blind.x || blind.y || blind.z || blind.rotations) {
    throw ValueError(device_text(capabilities) + "driven axes are " + axes_text(driven) + ", sensed ones " +
                     axes_text(sensed) + ": must be sensed too: " + axes_text(blind));
  }
}

void require_translations(const Capabilities& capabilities, const char* user) {
  if (capabilities.sensed.all_translations() && capabilities.driven.all_translations()) return;
  throw ValueError(device_text(capabilities) + "sensed axes are " + axes_text(capabilities.sensed) +
                   ", driven axes are " + axes_text(capabilities.driven) + "; " + user +
                   " needs x, y and z to be sensed and driven");
}

}  // namespace calligraphy
