// A clock that never runs backwards and keeps running while the machine is suspended.
#pragma once

#include <chrono>
#include <cmath>

#if defined(__linux__)
#include <ctime>
#endif

namespace calligraphy {

/// Seconds since some moment before the program began. Time during a suspension counts: to a servo loop it is a gap
/// like any other. Neither blocks nor allocates.
inline double monotonic_seconds() noexcept {
#if defined(__linux__)
  std::timespec time = {};
  clock_gettime(CLOCK_BOOTTIME,
                &time);  // CLOCK_MONOTONIC, and so std::chrono::steady_clock, stops meanwhile
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
#else
  // On Windows and macOS this clock counts it too.
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
#endif
}

/// A time without the digits that the clock does not have, which would only take space in recordings [s].
inline double whole_nanoseconds(double seconds) noexcept { return std::round(1e9 * seconds) / 1e9; }

/// Duration of `work` [s]. Its result is stored, so that the compiler cannot omit the computation.
template <typename Work>
double seconds_of(const Work& work) {
  const double start = monotonic_seconds();
  volatile double kept = work();
  const double end = monotonic_seconds();
  static_cast<void>(kept);
  return end - start;
}

}  // namespace calligraphy
