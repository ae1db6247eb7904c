// Whichever instructions the processor has, the signs that the nearest point rests on are the same.
#include "../catch.hpp"

#include <cstddef>

#include <calligraphy/collision/stroke_element.hpp>

#include "../hard_cases.hpp"
#include "collision/slope_signs.hpp"

using namespace calligraphy;
using calligraphy_test::hard_curves;
using calligraphy_test::hard_queries;
using calligraphy_test::HardCurve;

#if defined(__SSE2__)

namespace {

using CellOrdinates = SlopeOrdinates<CurveElement::max_ordinates>;
using CellSigns = SlopeSigns<CurveElement::max_ordinates>;

[[gnu::target("avx2")]] CellSigns with_avx2(const CellOrdinates& ordinates, Pair query) {
  return slope_signs_avx2(ordinates, query);
}

/// Where they are not certain nobody asks for them.
template <std::size_t Count>
bool same(const SlopeSigns<Count>& a, const SlopeSigns<Count>& b) {
  return a.certain == b.certain && (!a.certain || a.negative == b.negative);
}

}  // namespace

TEST_CASE("plain C++, SSE2 and AVX2 find the same signs on every hard curve", "[collision]") {
  int different = 0, uncertain = 0, asked = 0;
  const bool has_avx2 = __builtin_cpu_supports("avx2");
  for (const HardCurve& curve : hard_curves()) {
    const StrokeElement element = prepare_element(curve.control_points);
    if (!element.curve()) continue;
    const auto& ordinates = element.curve()->ordinates;
    const auto& whole = element.curve()->whole;
    for (const Point& query : hard_queries(curve, 200)) {
      const Point relative = (query - element.origin()) / element.size();
      const CellSigns plain = slope_signs_portable(ordinates, pair(relative));
      different += !same(plain, slope_signs_sse2(ordinates, pair(relative)));
      different += has_avx2 && !same(plain, with_avx2(ordinates, pair(relative)));
      different += !same(slope_signs_portable(whole, pair(relative)), slope_signs_sse2(whole, pair(relative)));
      uncertain += !plain.certain;
      ++asked;
    }
  }
  INFO(asked << " queries, AVX2 " << has_avx2);
  CHECK(different == 0);
  CHECK(uncertain > 0);
  CHECK(uncertain < asked);
}

#endif

TEST_CASE("a sign of the slope that is called certain is the sign in long double", "[collision]") {
  int wrong = 0, certain = 0;
  for (const HardCurve& curve : hard_curves()) {
    const StrokeElement element = prepare_element(curve.control_points);
    if (!element.curve() || curve.tolerance > 1e-9) continue;
    const CurveElement& c = *element.curve();
    for (const Point& query : hard_queries(curve, 100)) {
      const Point relative = (query - c.origin) * c.per_size;
      const CertainSigns signs = certain_signs(c.ordinates, pair(relative));
      // The first and the last ordinate of a cell are the slope there, but for zeros at the ends that are divided out.
      for (int cell = 1; cell < c.cells; ++cell) {
        const long double t = static_cast<long double>(cell) / c.cells;
        long double x = 0.0L, y = 0.0L, dx = 0.0L, dy = 0.0L;
        for (int k = c.degree; k >= 1; --k) {
          const Point& factor = c.coefficients[static_cast<std::size_t>(k - 1)];
          x = (x + factor.x()) * t, y = (y + factor.y()) * t;
          dx = dx * t + k * static_cast<long double>(factor.x());
          dy = dy * t + k * static_cast<long double>(factor.y());
        }
        const long double slope = (x - relative.x()) * dx + (y - relative.y()) * dy;
        const int bit = (2 * c.degree - 1) * cell;
        const bool negative = (signs.negative >> bit) & 1U, positive = (signs.positive >> bit) & 1U;
        certain += negative || positive;
        wrong += (negative && slope > 0.0L) || (positive && slope < 0.0L);
      }
    }
  }
  CHECK(certain > 10'000);
  CHECK(wrong == 0);
}
