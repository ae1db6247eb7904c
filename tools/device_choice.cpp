#include "device_choice.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#ifdef CALLIGRAPHY_WITH_PHANTOM
#include <calligraphy/devices/phantom/device_list.hpp>
#include <calligraphy/devices/phantom/phantom_device.hpp>
#include <calligraphy/devices/phantom/wire_profile.hpp>
#endif
#ifdef CALLIGRAPHY_WITH_OPENHAPTICS
#include <calligraphy/devices/openhaptics/openhaptics_device.hpp>
#endif

#include "commands.hpp"
#include "options.hpp"
#include "output_file.hpp"

namespace calligraphy::tools {
namespace {

constexpr std::array<std::pair<const char*, DeviceKind>, 3> kinds = {{{"simulated", DeviceKind::simulated},
                                                                      {"phantom", DeviceKind::phantom},
                                                                      {"openhaptics", DeviceKind::openhaptics}}};

bool is_profile(const std::string& name) {
  const auto profiles = device_profiles();
  return std::any_of(profiles.begin(), profiles.end(), [&name](const auto& profile) { return profile.name == name; });
}

[[noreturn]] void refuse(const std::string& text, const std::string& reason) {
  throw UsageError(
      fmt::format("--device: {}: {}; expected [simulated:]NAME with NAME one of {}, phantom[:SERIAL] or "
                  "openhaptics[:NAME]; a device of your own is driven from C++, C or Python (docs/own-backend.md)",
                  text, reason, device_names()));
}

#ifdef CALLIGRAPHY_WITH_PHANTOM
[[noreturn]] void refuse_without_wire_profile() {
  const std::string needed =
      "--wire-profile is required, because the packets of a Phantom are not public: docs/wire-profile.md tells how to "
      "describe those that `calligraphy devices probe` captures";
  if (plugged_devices().empty()) throw DeviceError("no Phantom is connected; with one, " + needed);
  throw UsageError(needed);
}
#endif

}  // namespace

DeviceChoice device_choice(const std::string& text) {
  if (is_profile(text)) return {DeviceKind::simulated, text, {}, {}};
  const std::size_t colon = text.find(':');
  const std::string name = text.substr(0, colon);
  const std::string which = colon == std::string::npos ? "" : text.substr(colon + 1);
  const auto kind = std::find_if(kinds.begin(), kinds.end(), [&name](const auto& each) { return each.first == name; });
  if (kind == kinds.end()) refuse(text, "unknown device");
  if (colon != std::string::npos && which.empty()) refuse(text, "nothing after the colon");
  if (kind->second == DeviceKind::simulated && !is_profile(which)) {
    refuse(text, which.empty() ? "no profile given" : "unknown profile");
  }
  return {kind->second, which, {}, {}};
}

void add_phantom_options(CLI::App& command, std::string& wire_profile, std::string& model) {
  CLI::Option* const layout =
      command
          .add_option("--wire-profile", wire_profile,
                      "Packet layout of a Phantom: a file, or the name of a shipped wire profile, which lacks the "
                      "calibration of your device; see docs/wire-profile.md (default: environment variable "
                      "CALLIGRAPHY_WIRE_PROFILE)")
          ->type_name("NAME|FILE");
#ifdef CALLIGRAPHY_WITH_PHANTOM
  layout->check(such_as(phantom::wire_profile_names()));
#endif
  command.add_option("--model", model, "Arm model of a Phantom (default: touch)")
      ->check(CLI::IsMember({"omni", "touch", "premium-1.5"}));
}

std::unique_ptr<HapticDevice> open_device(const DeviceChoice& choice, [[maybe_unused]] bool drive) {
#ifdef CALLIGRAPHY_WITH_PHANTOM
  if (choice.kind == DeviceKind::phantom) {
    PhantomOptions options;
    options.serial = choice.which;
    const char* const environment = std::getenv("CALLIGRAPHY_WIRE_PROFILE");
    if (environment != nullptr) options.wire_profile = environment;
    if (!choice.wire_profile.empty()) options.wire_profile = choice.wire_profile;
    if (options.wire_profile.empty()) refuse_without_wire_profile();
    if (!choice.model.empty()) options.model = choice.model;
    options.drive = drive;
    return std::make_unique<PhantomDevice>(options);
  }
#endif
#ifdef CALLIGRAPHY_WITH_OPENHAPTICS
  if (choice.kind == DeviceKind::openhaptics) {
    keep_output_to_ourselves();
    OpenHapticsOptions options;
    options.device = choice.which;
    return std::make_unique<OpenHapticsDevice>(options);
  }
#endif
  throw UsageError(fmt::format("--device: this program was built without the {}",
                               choice.kind == DeviceKind::phantom
                                   ? "phantom backend (CALLIGRAPHY_PHANTOM=ON)"
                                   : "openhaptics backend (CALLIGRAPHY_OPENHAPTICS=ON)"));
}

}  // namespace calligraphy::tools
