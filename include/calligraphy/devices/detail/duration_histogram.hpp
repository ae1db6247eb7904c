// Percentiles of durations, counted by one thread and read by any.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include <calligraphy/devices/servo_statistics.hpp>

namespace calligraphy {

/// Fixed buckets, 128 to each doubling: a percentile is off by at most 1/256 of itself, or 1 ns. Durations beyond 18
/// minutes count in the last bucket. add() is wait-free and takes no memory; summary() may run meanwhile and then
/// misses at most what is added during the call.
class DurationHistogram {
 public:
  static constexpr double relative_error = 1.0 / 256.0;

  /// One thread at a time. Below 0 or not a number counts as 0 [s].
  void add(double seconds) noexcept;

  DurationSummary summary() const noexcept;

 private:
  static constexpr std::size_t per_octave = 128;
  static constexpr std::size_t octaves = 34;  ///< the first holds 0 to 127 ns singly

  std::array<std::atomic<std::uint64_t>, octaves* per_octave> buckets_ = {};
  std::atomic<std::uint64_t> worst_ = 0;  ///< [ns]
};

}  // namespace calligraphy
