// What the error codes of the vendor's runtime mean for a device.
#pragma once

#include <calligraphy/devices/device_state.hpp>

#include "hdapi.hpp"

namespace calligraphy::hdapi {

struct Judgement {
  DeviceStatus status = DeviceStatus::ok;
  DeviceFault fault = DeviceFault::none;
};

/// A code that is not known counts as a fault.
Judgement judge(ErrorCode code) noexcept;

/// The graver one; of equals the first.
Judgement graver(const Judgement& a, const Judgement& b) noexcept;

}  // namespace calligraphy::hdapi
