// The processor-specific part of the nearest point: the same signs on every kind of processor.
#include "../catch.hpp"

#include <vector>

#include <calligraphy/collision/nearest_point.hpp>

#include "../hard_cases.hpp"
#include "collision/slope_signs.hpp"

using namespace calligraphy;
using detail::CurveElement;
using detail::LineElement;
using calligraphy_test::hard_curves;
using calligraphy_test::hard_queries;
using calligraphy_test::HardCurve;
using calligraphy_test::Sequence;

namespace {

using Signs = SlopeSigns<CurveElement::max_ordinates>;

template <std::size_t Count>
bool same(const SlopeSigns<Count>& a, const SlopeSigns<Count>& b) {
  return a.certain == b.certain && (!a.certain || a.negative == b.negative);
}

#if defined(__SSE2__)
template <std::size_t Count>
[[gnu::target("avx2")]] SlopeSigns<Count> wide_signs(const detail::SlopeOrdinates<Count>& ordinates, Pair query) {
  return slope_signs_avx2(ordinates, query);
}

template <std::size_t Count>
bool same_signs(const detail::SlopeOrdinates<Count>& ordinates, Pair query) {
  const SlopeSigns<Count> plain = slope_signs_portable(ordinates, query);
  return same(plain, slope_signs_sse2(ordinates, query)) &&
         (!__builtin_cpu_supports("avx2") || same(plain, wide_signs(ordinates, query)));
}
#endif

}  // namespace

TEST_CASE("plain, SSE2 and AVX2 code give the same signs", "[collision]") {
#if defined(__SSE2__)
  Sequence random(17);
  int different = 0, compared = 0;
  for (const HardCurve& curve : hard_curves()) {
    const StrokeElement element = prepare_element(curve.control_points);
    if (!element.curve()) continue;
    const auto compare = [&, &prepared = *element.curve()](Pair query) {
      different += !same_signs(prepared.ordinates, query) || !same_signs(prepared.whole, query);
      ++compared;
    };
    for (const Point& query : hard_queries(curve, 200)) {
      compare((pair(query) - pair(element.origin())) * element.curve()->per_size);
      const Point direction = random.point(-1.0, 1.0);
      for (const double distance : {1e30, 1e37, 1e38, 3e38, 1e39}) compare(distance * pair(direction));  // of a float's
    }
  }
  CHECK(different == 0);
  CHECK(compared > 10'000);
#else
  SUCCEED("only the plain code is built for this processor");
#endif
}

TEST_CASE("certain signs agree with the slope in double precision", "[collision]") {
  Sequence random(31);
  int wrong = 0, certain = 0;
  for (int i = 0; i < 200; ++i) {
    std::vector<Point> points;
    for (int k = 0; k < 4; ++k) points.push_back(random.point(0.0, 1.0));
    const CurveElement curve = detail::prepare_curve(points);
    for (int k = 0; k < 50; ++k) {
      const Point query = random.point(-1.0, 2.0);
      const Signs signs = slope_signs(curve.ordinates, (pair(query) - pair(curve.origin)) * curve.per_size);
      if (!signs.certain) continue;
      ++certain;
      // No sign change means that the distance is monotone; the ends tell in which direction.
      const auto slope_at = [&](double t) { return (curve.point(t) - query).dot(curve.derivative(t)); };
      wrong += signs.first_negative() != (slope_at(0.0) < 0.0);
      wrong += signs.last_negative() != (slope_at(1.0) < 0.0);
      if (signs.changes() != 0) continue;
      for (int step = 1; step < 20; ++step) wrong += (slope_at(step / 20.0) < 0.0) != signs.first_negative();
    }
  }
  CHECK(wrong == 0);
  CHECK(certain > 9'000);
}

TEST_CASE("a line takes at most 64 bytes and a curve at most 1200", "[collision]") {
  CHECK(sizeof(LineElement) <= 64);
  CHECK(sizeof(CurveElement) <= 1200);
}
