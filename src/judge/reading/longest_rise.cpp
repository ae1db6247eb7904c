#include "longest_rise.hpp"

#include <algorithm>

namespace calligraphy {

std::vector<std::size_t> longest_rise(std::span<const std::size_t> numbers) {
  std::vector<std::size_t> lasts;   // the least number with which a series of this length ends
  std::vector<std::size_t> length;  // of the longest series that ends with each number
  for (const std::size_t number : numbers) {
    const auto at = std::lower_bound(lasts.begin(), lasts.end(), number);
    length.push_back(static_cast<std::size_t>(at - lasts.begin()) + 1);
    if (at == lasts.end()) {
      lasts.push_back(number);
    } else {
      *at = number;
    }
  }
  std::vector<std::size_t> places(lasts.size());
  std::size_t wanted = lasts.size();
  for (std::size_t i = numbers.size(); i-- > 0 && wanted > 0;) {
    // Of those before it that end a series one shorter, the last is the least.
    if (length[i] == wanted) places[--wanted] = i;
  }
  return places;
}

}  // namespace calligraphy
