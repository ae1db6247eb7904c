// Timing of a computation.
#pragma once

#include <chrono>

namespace calligraphy {

/// Duration of `work` [s]. Its result is kept, so that the computation is not optimised away.
template <typename Work>
double seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  volatile double kept = work();
  const auto end = std::chrono::steady_clock::now();
  static_cast<void>(kept);
  return std::chrono::duration<double>(end - start).count();
}

}  // namespace calligraphy
