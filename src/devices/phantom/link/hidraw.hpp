// Queries the device of an open hidraw node.
#pragma once

#include <calligraphy/devices/phantom/device_list.hpp>

namespace calligraphy::phantom {

/// Whether the descriptor belongs to a hidraw node of a device with these ids; false for -1, and once the device is
/// being unplugged.
bool hidraw_answers(int descriptor, const PluggedDevice& device) noexcept;

}  // namespace calligraphy::phantom
