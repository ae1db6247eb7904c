// The device named by --device.
#pragma once

#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include <calligraphy/devices/haptic_device.hpp>

namespace calligraphy::tools {

enum class DeviceKind {
  simulated,   ///< a profile
  phantom,     ///< over USB
  openhaptics  ///< through the vendor's runtime
};

struct DeviceChoice {
  DeviceKind kind = DeviceKind::simulated;
  std::string which;         ///< profile, serial number or name; empty: the only device present
  std::string wire_profile;  ///< Phantom only: name or file; empty: environment variable CALLIGRAPHY_WIRE_PROFILE
  std::string model;         ///< Phantom only: arm model; empty: touch
};

/// "simulated:NAME" or a profile's bare name, "phantom[:SERIAL]", "openhaptics[:NAME]".
/// @throws UsageError listing the accepted forms
DeviceChoice device_choice(const std::string& text);

/// Adds --wire-profile and --model, for a Phantom.
void add_phantom_options(CLI::App& command, std::string& wire_profile, std::string& model);

/// Opens a phantom or openhaptics device; without `drive` its motors stay off. @throws DeviceError; UsageError if this
/// program was built without that backend
std::unique_ptr<HapticDevice> open_device(const DeviceChoice& choice, bool drive = true);

}  // namespace calligraphy::tools
