// Time that work takes.
#pragma once

#include <chrono>

namespace calligraphy {

/// Seconds that `work` takes. What it returns is kept, or nothing would have to be computed.
template <typename Work>
double seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  volatile double kept = work();
  const auto end = std::chrono::steady_clock::now();
  static_cast<void>(kept);
  return std::chrono::duration<double>(end - start).count();
}

}  // namespace calligraphy
