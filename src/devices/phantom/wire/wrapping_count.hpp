// Difference of counts that are reported modulo 2^n.
#pragma once

#include <cstdint>

namespace calligraphy::phantom {

/// The shorter way from one reported value to the next: correct as long as the count changes by less than half its
/// range between two reports.
inline std::int64_t min_step(std::int64_t from, std::int64_t to, int bits) noexcept {
  const std::int64_t range = std::int64_t{1} << bits;
  const std::int64_t ahead = (to - from) & (range - 1);
  return ahead < range / 2 ? ahead : ahead - range;
}

}  // namespace calligraphy::phantom
