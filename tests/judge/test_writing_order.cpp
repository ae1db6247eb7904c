#include <cstddef>
#include <vector>

#include <judge/reading/writing_order.hpp>

#include "../catch.hpp"
#include "../hard_cases.hpp"

using namespace calligraphy;
using Numbers = std::vector<std::size_t>;

namespace {

/// Of all series, by trying each.
std::size_t longest_of_all(const Numbers& numbers) {
  std::size_t longest = 0;
  for (std::size_t chosen = 0; chosen < (std::size_t{1} << numbers.size()); ++chosen) {
    Numbers series;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if ((chosen >> i) % 2 == 1) series.push_back(numbers[i]);
    }
    bool rises = true;
    for (std::size_t i = 1; i < series.size(); ++i) rises = rises && series[i - 1] < series[i];
    if (rises) longest = std::max(longest, series.size());
  }
  return longest;
}

}  // namespace

TEST_CASE("the longest rise is as long as the longest of all series that rise", "[judge]") {
  calligraphy_test::Sequence random(7);
  for (int i = 0; i < 200; ++i) {
    Numbers numbers;
    for (int k = i % 10; k > 0; --k) numbers.push_back(static_cast<std::size_t>(10.0 * random.next()));
    const Numbers places = longest_rise(numbers);
    CAPTURE(numbers, places);
    CHECK(places.size() == longest_of_all(numbers));
    for (std::size_t k = 1; k < places.size(); ++k) {
      CHECK(places[k - 1] < places[k]);
      CHECK(numbers[places[k - 1]] < numbers[places[k]]);
    }
  }
}

TEST_CASE("of several longest rises the one that comes last is taken", "[judge]") {
  CHECK(longest_rise(Numbers{1, 0}) == Numbers{1});
  CHECK(longest_rise(Numbers{0, 2, 1, 3}) == Numbers{0, 2, 3});
  CHECK(longest_rise(Numbers{}).empty());
}
