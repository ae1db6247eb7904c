// Where a stroke attracts: Wang 2006, sec. 4.3.1 (a)-(d) as printed, and the tube that replaces it.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>

#include <calligraphy/collision/constraint_space.hpp>

namespace constraint_space_tests {

using namespace calligraphy;

namespace {

constexpr double em = 0.04;  // [m]
constexpr Rules printed = Rules::wang2006;

StrokeElement element_of(std::vector<Point> points) { return prepare_element(points); }

double share_at(const ConstraintSpace& space, const StrokeElement& element, const Point& query) {
  return guidance_weight(space, em, element, query, nearest_point(element, query));
}
double share_at(Rules rules, const StrokeElement& element, const Point& query) {
  return guidance_weight({}, em, element, query, nearest_point(element, query), rules);
}

const StrokeElement horizontal = element_of({{0.01, 0.02}, {0.05, 0.02}});  // 40 mm

}  // namespace

TEST_CASE("rule (a): behind the start of a line there is no guidance as printed", "[collision]") {
  CHECK(share_at(printed, horizontal, {0.0101, 0.02}) == 1.0);
  CHECK(share_at(printed, horizontal, {0.01, 0.02}) == 0.0);  // on the boundary: not ahead
  CHECK(share_at(printed, horizontal, {0.0099, 0.02}) == 0.0);
  CHECK(share_at(printed, horizontal, {0.0101, 0.02 + 0.039}) == 1.0);
  CHECK(share_at(printed, horizontal, {0.0099, 0.02 + 0.039}) == 0.0);
}

TEST_CASE("rules (b) and (c): guidance as printed reaches as far from the start as the line is long", "[collision]") {
  CHECK(share_at(printed, horizontal, {0.0499, 0.02}) == 1.0);
  CHECK(share_at(printed, horizontal, {0.0501, 0.02}) == 0.0);
  CHECK(share_at(printed, horizontal, {0.01 + 0.0282, 0.02 + 0.0282}) == 1.0);  // 39.9 mm at 45 degrees
  CHECK(share_at(printed, horizontal, {0.01 + 0.0284, 0.02 + 0.0284}) == 0.0);  // 40.2 mm
}

TEST_CASE("rule (d): a point as printed always attracts", "[collision]") {
  const StrokeElement point = element_of({{0.01, 0.02}, {0.01, 0.02}});
  CHECK(share_at(printed, point, {0.01, 0.02}) == 1.0);
  CHECK(share_at(printed, point, {0.5, -3.0}) == 1.0);
}

TEST_CASE("a curve as printed attracts within a disc around its start, behind it too", "[collision]") {
  const StrokeElement curve = element_of({{0, 0}, {0.01, 0.01}, {0.02, 0.01}, {0.03, 0}});
  CHECK(share_at(printed, curve, {-0.0299, 0}) == 1.0);
  CHECK(share_at(printed, curve, {-0.0301, 0}) == 0.0);
  CHECK(share_at(printed, curve, {0, 0.0299}) == 1.0);
}

TEST_CASE("as printed, the half disc drops the whole force of a deviation before the end of a stroke", "[collision]") {
  // At lateral deviation d the half disc ends where x^2 + d^2 = L^2, which is before the end of the stroke, and K d
  // drops to 0 at once.
  const double length = 0.04, stiffness = 400.0;
  for (const double deviation : {0.001, 0.003, 0.008, 0.02}) {
    const double border = std::sqrt(length * length - deviation * deviation);
    const auto force = [&](const auto& space, double x) {
      const Point query = horizontal.origin() + Point(x, deviation);
      return stiffness * share_at(space, horizontal, query) * nearest_point(horizontal, query).distance;
    };
    CHECK(border < length);
    const double drop = force(printed, border - 1e-7) - force(printed, border + 1e-7);
    CHECK(drop == Approx(stiffness * deviation).epsilon(1e-9));
    const ConstraintSpace tube;
    CHECK(std::abs(force(tube, border - 1e-7) - force(tube, border + 1e-7)) < 1e-3 * stiffness * deviation);
  }
}

TEST_CASE("the weight of the tube is 1 inside, 0 outside, and without step or kink in between", "[collision]") {
  const ConstraintSpace tube{0.2, 0.075};  // 8 mm and 3 mm
  const auto share = [&](double y) { return share_at(tube, horizontal, {0.03, 0.02 + y}); };
  CHECK(share(0.0) == 1.0);
  CHECK(share(0.005) == Approx(1.0));
  CHECK(share(0.0065) == Approx(0.5));
  CHECK(share(0.008) == 0.0);
  CHECK(share(1.0) == 0.0);
  const double step = 1e-6;
  double max_step = 0.0, max_bend = 0.0, rises = 0.0;
  for (double y = 0.0; y < 0.010; y += step) {
    const double before = share(y), at = share(y + step), after = share(y + 2.0 * step);
    max_step = std::max(max_step, std::abs(at - before));
    max_bend = std::max(max_bend, std::abs(after - 2.0 * at + before));
    rises = std::max(rises, at - before);
  }
  CHECK(rises <= 1e-12);
  CHECK(max_step <= 1.5 / 0.003 * step * 1.001);                  // slope of the smooth step: 3/2 per fade width
  CHECK(max_bend <= 6.0 / (0.003 * 0.003) * step * step * 1.01);  // a kink would bend by a whole slope
}

TEST_CASE("the tube is the same on both sides of a stroke and around both of its ends", "[collision]") {
  const ConstraintSpace tube;
  for (double x = -0.012; x < 0.06; x += 0.0011) {
    for (double y = 0.0; y < 0.012; y += 0.0007) {
      const double above = share_at(tube, horizontal, {0.01 + x, 0.02 + y});
      CHECK(above == Approx(share_at(tube, horizontal, {0.01 + x, 0.02 - y})).margin(1e-12));
      CHECK(above == Approx(share_at(tube, horizontal, {0.05 - x, 0.02 + y})).margin(1e-12));
    }
  }
}

TEST_CASE("the tube is as wide as the square that is written in says", "[collision]") {
  const ConstraintSpace tube;
  for (const double size : {0.01, 0.02, 0.2}) {
    const StrokeElement element = element_of({{0.0, 0.0}, {size, 0.0}});
    for (const double offset : {0.05, 0.15, 0.2, 0.25, 0.31}) {  // [em]
      const Point query = size * Point(0.5, offset), in_40_mm = horizontal.point(0.5) + em * Point(0.0, offset);
      const double weight = guidance_weight(tube, size, element, query, nearest_point(element, query));
      CHECK(weight == Approx(share_at(tube, horizontal, in_40_mm)).margin(1e-12));
    }
  }
}

TEST_CASE("the fade may fill the whole tube, and a query that is not finite is outside", "[collision]") {
  const ConstraintSpace tube{0.2, 0.2};
  CHECK(share_at(tube, horizontal, {0.03, 0.02}) == 1.0);
  CHECK(share_at(tube, horizontal, {0.03, 0.024}) == Approx(0.5));
  CHECK(share_at(tube, horizontal, {std::nan(""), 0.02}) == 0.0);
  CHECK(share_at(printed, horizontal, {std::nan(""), 0.02}) == 0.0);
}

}  // namespace constraint_space_tests
