// The shipped descriptions of devices.
#pragma once

#include <span>
#include <string_view>

#include <calligraphy/devices/capabilities.hpp>

namespace calligraphy {

/// omni, touch, desktop, premium-1.5, ideal (no friction, encoder step or delay).
/// Apparent masses and some frictions are estimates, not the vendor's figures: docs/devices.md names each source.
std::span<const Capabilities> device_profiles();

/// @throws ValueError naming the name and those that exist
const Capabilities& device_profile(std::string_view name);

}  // namespace calligraphy
