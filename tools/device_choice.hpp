// Which device --device names.
#pragma once

#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include <calligraphy/devices/haptic_device.hpp>

namespace calligraphy::tools {

enum class DeviceKind {
  simulated,   ///< a profile
  replay,      ///< a trace that `write` recorded
  phantom,     ///< over USB
  openhaptics  ///< by the vendor's runtime
};

struct DeviceChoice {
  DeviceKind kind = DeviceKind::simulated;
  std::string which;         ///< profile, file, serial number or name; empty: the only one there is
  std::string wire_profile;  ///< of a phantom: name or file; empty: as the environment's CALLIGRAPHY_WIRE_PROFILE
  std::string model;         ///< of a phantom: its arm; empty: touch
};

/// "simulated:NAME" or a profile's bare name, "replay:FILE", "phantom[:SERIAL]", "openhaptics[:NAME]".
/// @throws UsageError naming what there is
DeviceChoice device_choice(const std::string& text);

/// --wire-profile and --model of a phantom.
void add_phantom_options(CLI::App& command, std::string& wire_profile, std::string& model);

/// A phantom or openhaptics device, opened; without `drive` its motors stay off. @throws DeviceError; UsageError when
/// this program was built without it
std::unique_ptr<HapticDevice> open_device(const DeviceChoice& choice, bool drive = true);

}  // namespace calligraphy::tools
