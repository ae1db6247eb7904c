// Built-in device profiles.
#pragma once

#include <span>
#include <string_view>

#include <calligraphy/devices/capabilities.hpp>

namespace calligraphy {

/// The built-in profiles: omni, touch, desktop, premium-1.5 and ideal (no friction, encoder step or delay).
/// Apparent masses and some friction values are estimates, not vendor data; docs/devices.md gives the sources.
std::span<const Capabilities> device_profiles();

/// The built-in profile with this name. @throws ValueError naming the unknown profile and the available ones
const Capabilities& device_profile(std::string_view name);

}  // namespace calligraphy
