// Maps the error codes of the vendor's runtime to device status and fault.
#pragma once

#include <calligraphy/devices/device_state.hpp>

#include "hdapi.hpp"

namespace calligraphy::hdapi {

struct Judgement {
  DeviceStatus status = DeviceStatus::ok;
  DeviceFault fault = DeviceFault::none;
};

/// An unknown code counts as a fault.
Judgement judge(ErrorCode code) noexcept;

/// Whether the error is about the arguments of a call, such as a value that the device does not have.
bool concerns_call(ErrorCode code) noexcept;

/// Whether an error that is pending after the scheduler was started means that it did not start. One about an argument
/// or a value is left over from another call, since starting takes none; those about forces and frames belong to the
/// ticks, which report them as long as they last.
bool prevents_start(ErrorCode code) noexcept;

/// The more severe one; the first if equal.
Judgement graver(const Judgement& a, const Judgement& b) noexcept;

}  // namespace calligraphy::hdapi
