// Statistics of a servo loop.
#pragma once

#include <array>
#include <cstdint>

#include <calligraphy/devices/device_state.hpp>

namespace calligraphy {

/// Summary of the durations counted by a histogram [s].
struct DurationSummary {
  std::uint64_t count = 0;  ///< number of durations
  double p50 = 0.0;         ///< median [s]
  double p99 = 0.0;         ///< 99th percentile [s]
  double p99_9 = 0.0;       ///< 99.9th percentile [s]
  double worst = 0.0;       ///< longest one, exact to a nanosecond [s]
};

/// Counts of a servo loop since its construction.
struct ServoStatistics {
  DurationSummary period;                ///< from one tick to the next, as reported by the clock [s]
  DurationSummary work;                  ///< duration of a tick: read, force law, write [s]
  std::uint64_t ticks = 0;               ///< ticks that reached the device
  std::uint64_t missed_deadlines = 0;    ///< skipped ticks: an interval of 3 periods counts 2
  std::uint64_t stale_samples = 0;       ///< ticks without a fresh sample
  std::uint64_t stalled_clock = 0;       ///< ticks whose time was not later than that of the previous tick
  std::uint64_t watchdog_takeovers = 0;  ///< times that the watchdog took over the device
  std::uint64_t idle_ticks = 0;          ///< ticks that wrote nothing because the watchdog had the device
  std::array<std::uint64_t, device_fault_count> faults = {};  ///< occurrences of each fault, by DeviceFault

  /// Occurrences of one fault.
  std::uint64_t fault_count(DeviceFault fault) const { return faults.at(static_cast<std::size_t>(fault)); }
};

}  // namespace calligraphy
