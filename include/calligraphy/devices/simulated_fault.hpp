// Faults that a simulated device shows on schedule, for tests of force laws.
#pragma once

#include <cstdint>

#include <calligraphy/devices/device_state.hpp>

namespace calligraphy {

/// What a simulated device shows during a fault.
enum class SimulatedFaultKind : std::uint8_t {
  stale,      ///< no new sample arrives: the last one again, with status `stale` and the cause `fault`
  late,       ///< samples are `ticks` older than usual, as their time shows
  garbage,    ///< position and velocity are NaN although the status is ok: a frame was lost or corrupted
  unplugged,  ///< the last sample, `disconnected`, with the cause `unplugged`; forces have no effect
  reported    ///< fresh samples with `status` and `fault`
};

/// One fault: active from virtual time `begin` until just before `begin` + `duration`.
struct SimulatedFault {
  double begin = 0.0;                                   ///< virtual time of the device [s]
  double duration = 0.0;                                ///< how long it lasts; infinity: forever [s]
  SimulatedFaultKind kind = SimulatedFaultKind::stale;  ///< what the device shows
  int ticks = 1;                              ///< late: 1 to 1000 advances more than the device's sample delay
  DeviceStatus status = DeviceStatus::fault;  ///< reported: the status of every sample
  DeviceFault fault = DeviceFault::none;      ///< stale, reported: the cause in every sample
};

}  // namespace calligraphy
