// The longest series of numbers that rise.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace calligraphy {

/// Places, in order, of as many numbers as possible that rise; of several such series, the one whose numbers come last.
/// O(n log n) (Fredman 1975).
std::vector<std::size_t> longest_rise(std::span<const std::size_t> numbers);

}  // namespace calligraphy
