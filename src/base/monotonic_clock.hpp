// The clock that never runs back.
#pragma once

#include <chrono>

namespace calligraphy {

/// Seconds since some moment before the program began. Neither blocks nor allocates.
inline double monotonic_seconds() noexcept {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
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
