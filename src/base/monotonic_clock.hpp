// The clock that never runs back, and goes on while the machine is suspended.
#pragma once

#include <chrono>

#if defined(__linux__)
#include <ctime>
#endif

namespace calligraphy {

/// Seconds since some moment before the program began. A suspension of the machine counts: to a servo loop it is a gap
/// like any other. Neither blocks nor allocates.
inline double monotonic_seconds() noexcept {
#if defined(__linux__)
  std::timespec time = {};
  clock_gettime(CLOCK_BOOTTIME,
                &time);  // CLOCK_MONOTONIC, and with it std::chrono::steady_clock, stands still meanwhile
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
#else
  // Windows and macOS count it here.
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
#endif
}

/// Seconds that `work` takes. What it returns is kept, or nothing would have to be computed.
template <typename Work>
double seconds_of(const Work& work) {
  const double start = monotonic_seconds();
  volatile double kept = work();
  const double end = monotonic_seconds();
  static_cast<void>(kept);
  return end - start;
}

}  // namespace calligraphy
