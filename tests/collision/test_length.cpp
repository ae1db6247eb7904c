#include <cmath>
#include <limits>

#include "../catch.hpp"
#include "../hard_cases.hpp"
#include "collision/length.hpp"

using namespace calligraphy;

TEST_CASE("a length is right to the last bit or two from the least number to the largest", "[collision]") {
  calligraphy_test::Sequence random(4);
  for (int exponent = -1074; exponent <= 1022; ++exponent) {
    const Point vector = random.point(-1.0, 1.0).unaryExpr([&](double x) { return std::ldexp(x, exponent); });
    const long double x = vector.x(), y = vector.y();
    const auto expected = static_cast<double>(std::sqrt(x * x + y * y));
    const double last_bit = std::nextafter(expected, std::numeric_limits<double>::infinity()) - expected;
    CAPTURE(exponent, x, y);
    REQUIRE(std::abs(length(vector) - expected) <= 2.0 * last_bit);
  }
}

TEST_CASE("a length along an axis is exact, of nothing zero, of what has no place none", "[collision]") {
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (const double size : {5e-324, 1e-310, 1e-200, 0.1, 3.0, 1e200, std::numeric_limits<double>::max()}) {
    CHECK(length({size, 0.0}) == size);
    CHECK(length({0.0, -size}) == size);
  }
  CHECK(length({0.0, 0.0}) == 0.0);
  CHECK(length({3.0, 4.0}) == 5.0);
  CHECK(length({-infinity, 1.0}) == infinity);
  CHECK(std::isnan(length({nan, 1.0})));
}
