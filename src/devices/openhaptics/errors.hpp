// Maps the error codes of the vendor's runtime to device status and fault.
#pragma once

#include <calligraphy/devices/device_state.hpp>

#include "hdapi.hpp"

namespace calligraphy::hdapi {

struct Diagnosis {
  DeviceStatus status = DeviceStatus::ok;
  DeviceFault fault = DeviceFault::none;
};

/// An unknown code counts as a fault.
Diagnosis diagnose(ErrorCode code) noexcept;

/// Whether the error is about the arguments of a call, such as a value that the device does not have.
bool concerns_call(ErrorCode code) noexcept;

/// Whether an error pending after the scheduler was started means that it did not start. An error about an argument or
/// a value is left over from another call, since starting takes none; those about forces and frames belong to the
/// ticks, which report them as long as they last.
bool prevents_start(ErrorCode code) noexcept;

/// The more severe of the two; the first if equal.
Diagnosis more_severe(const Diagnosis& a, const Diagnosis& b) noexcept;

}  // namespace calligraphy::hdapi
