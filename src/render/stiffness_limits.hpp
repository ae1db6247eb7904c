// Limits of stiffness and damping that hold for every device.
#pragma once

namespace calligraphy {

/// Maximum stiffness on a device that states no limit; keeps every force finite [N/m].
inline constexpr double max_stiffness = 1e6;

/// Maximum damping, for the same reason [N s/m].
inline constexpr double max_damping = 1e6;

}  // namespace calligraphy
