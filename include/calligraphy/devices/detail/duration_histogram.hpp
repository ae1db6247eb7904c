// Histogram of durations, written by one thread and readable by any.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include <calligraphy/devices/servo_statistics.hpp>

namespace calligraphy::detail {

/// Fixed buckets, 128 per octave: the error of a percentile is at most 1/256 of its value, or 1 ns. Durations above 18
/// minutes count in the last bucket. add() is wait-free and does not allocate; a concurrent summary() misses at most
/// what is added during the call.
class DurationHistogram {
 public:
  static constexpr double relative_error = 1.0 / 256.0;

  /// Call from one thread at a time. A negative duration or NaN counts as 0 [s].
  void add(double seconds) noexcept;

  DurationSummary summary() const noexcept;

 private:
  static constexpr std::size_t per_octave = 128;
  static constexpr std::size_t octaves = 34;  ///< the first has one bucket per ns, 0 to 127

  std::array<std::atomic<std::uint64_t>, octaves* per_octave> buckets_ = {};
  std::atomic<std::uint64_t> worst_ = 0;  ///< [ns]
};

}  // namespace calligraphy::detail
