// A count that a field shows modulo 2^n.
#pragma once

#include <cstdint>

namespace calligraphy::phantom {

/// The way from one shown value to the next, taken as the shorter one: right while a count moves by less than half its
/// range between two reports.
inline std::int64_t shortest_step(std::int64_t from, std::int64_t to, int bits) noexcept {
  const std::int64_t range = std::int64_t{1} << bits;
  const std::int64_t ahead = (to - from) & (range - 1);
  return ahead < range / 2 ? ahead : ahead - range;
}

}  // namespace calligraphy::phantom
