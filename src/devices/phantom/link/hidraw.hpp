// What an open hidraw node says about its device.
#pragma once

#include <calligraphy/devices/phantom/device_list.hpp>

namespace calligraphy::phantom {

/// Whether the descriptor is that of a hidraw node of a device with these ids; false once its unplugging has begun, and
/// for -1.
bool hidraw_answers(int descriptor, const PluggedDevice& device) noexcept;

}  // namespace calligraphy::phantom
