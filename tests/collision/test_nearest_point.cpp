// The exact nearest point against brute force in long double (Wang 2006, sec. 4.3.1, 4.3.2).
#include "../catch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <calligraphy/collision/nearest_point.hpp>

#include "../allocation_counter.hpp"
#include "../hard_cases.hpp"
#include "../reference_curve.hpp"
#include "../sanitized.hpp"
#include "../special_values.hpp"

using namespace calligraphy;
using calligraphy_test::hard_curves;
using calligraphy_test::hard_queries;
using calligraphy_test::HardCurve;
using calligraphy_test::ReferenceCurve;
using calligraphy_test::Sequence;

namespace {

using calligraphy_test::infinity;
using calligraphy_test::not_a_number;
constexpr int fuzz_queries = calligraphy_test::sanitized ? 20'000 : 200'000;

/// Error of the distance relative to the size, beyond what rounding of the distance of a far query permits.
double error_of(const NearestPoint& found, const ReferenceCurve& reference, const Point& query, const HardCurve& curve,
                const ParameterRange& range = {}) {
  const auto expected = reference.nearest(query, range.begin, range.end, 400);
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * static_cast<double>(expected.distance);
  const double size = std::max(calligraphy_test::size_of(curve.control_points), 1e-300);
  const double error = std::abs(static_cast<double>(found.distance - expected.distance)) - rounding;
  const bool consistent = std::abs((query - found.point).norm() - found.distance) <=
                          1e-9 * size + rounding + (curve.tolerance > 1e-9 ? 1e-7 : 0.0);
  const bool in_range = found.parameter >= range.begin && found.parameter <= range.end;
  return consistent && in_range ? error / size : infinity;
}

}  // namespace

TEST_CASE("the exact nearest point agrees with brute force on every hard curve", "[collision]") {
  for (const HardCurve& curve : hard_curves()) {
    const StrokeElement element = prepare_element(curve.control_points);
    const ReferenceCurve reference(curve.control_points);
    double worst = 0.0;
    int uncertified = 0;
    Point worst_query = Point::Zero();
    for (const Point& query : hard_queries(curve)) {
      const NearestPoint found = nearest_point(element, query);
      const double error = error_of(found, reference, query, curve);
      uncertified += !found.certified();
      if (error > worst) worst = error, worst_query = query;
    }
    INFO(curve.name << ", query (" << worst_query.x() << ", " << worst_query.y() << ")");
    CHECK(worst <= curve.tolerance);
    CHECK(uncertified == 0);
  }
}

TEST_CASE("the exact nearest point agrees with brute force within a range of an element", "[collision]") {
  constexpr ParameterRange ranges[] = {{0.0, 0.3}, {0.2, 0.7}, {0.55, 1.0}, {0.4, 0.4}, {0.999, 1.0}, {0.0, 1e-9}};
  for (const HardCurve& curve : hard_curves()) {
    const StrokeElement element = prepare_element(curve.control_points);
    const ReferenceCurve reference(curve.control_points);
    double worst = 0.0;
    for (const ParameterRange& range : ranges) {
      std::vector<Point> queries = hard_queries(curve, 4);
      if (calligraphy_test::sanitized) queries.resize(4);
      for (const Point& query : queries) {
        worst = std::max(worst, error_of(nearest_point(element, query, {}, range), reference, query, curve, range));
      }
    }
    INFO(curve.name);
    CHECK(worst <= curve.tolerance);
  }
}

TEST_CASE("a query on the curve is its own nearest point", "[collision]") {
  for (const HardCurve& curve : hard_curves()) {
    const StrokeElement element = prepare_element(curve.control_points);
    double worst = 0.0;
    for (int i = 0; i <= 50; ++i) {
      const auto at = ReferenceCurve(curve.control_points).point(i / 50.0L);
      worst =
          std::max(worst, nearest_point(element, {static_cast<double>(at[0]), static_cast<double>(at[1])}).distance);
    }
    INFO(curve.name);
    CHECK(worst <= curve.tolerance * element.size());
  }
}

TEST_CASE("ties go to the smaller parameter", "[collision]") {
  const auto parameter = [](std::vector<Point> points, const Point& query) {
    return nearest_point(prepare_element(points), query).parameter;
  };
  CHECK(parameter({{0, 0}, {0, 1}, {1, 1}, {1, 0}}, {0.5, 0.0}) == 0.0);   // both ends of an arch
  CHECK(parameter({{0, 0}, {1, 1}, {-1, 1}, {0, 0}}, {0.0, 0.0}) == 0.0);  // both ends of a closed curve
  CHECK(parameter({{0, 0}, {0.5, 1}, {1, 0}}, {0.5, -1.0}) == 0.0);
  CHECK(parameter({{0, 0}, {0, 0}, {0, 0}, {0, 0}}, {1.0, 2.0}) == 0.0);  // a point
  CHECK(parameter({{1, 1}, {1, 1}}, {0.0, 0.0}) == 0.0);
  CHECK(parameter({{0, 0}, {1, 0}, {1, 0}, {0, 0}}, {0.375, 0.0}) ==
        Approx(parameter({{0, 0}, {1, 0}, {1, 0}, {0, 0}}, {0.375, 1e-12})));  // there and back over the same points
  CHECK(parameter({{0, 0}, {1, 0}, {1, 0}, {0, 0}}, {0.5, 0.3}) < 0.5);
  // A tie of two inner minima is resolved up to rounding: the same distance, the same result every time.
  const StrokeElement s = prepare_element(std::vector<Point>{{0, 0}, {1, 0}, {0, 1}, {1, 1}});
  CHECK(nearest_point(s, {0.5, 0.5}).parameter == nearest_point(s, {0.5, 0.5}).parameter);
}

TEST_CASE("at the centre of an arc, where all its points are equally near, one of them is found", "[collision]") {
  const double k = 0.5522847498307936;
  const StrokeElement arc = prepare_element(std::vector<Point>{{1, 0}, {1, k}, {k, 1}, {0, 1}});
  const NearestPoint found = nearest_point(arc, {0, 0});
  CHECK(found.certified());
  CHECK(found.distance == Approx(1.0).margin(1e-9));  // this cubic leaves the circle outwards by at most 2.7e-4
  // Centre of curvature of the parabola y = 2 x (1 - x) at its vertex: three zeros of the slope coincide there.
  const StrokeElement parabola = prepare_element(std::vector<Point>{{0, 0}, {0.5, 1}, {1, 0}});
  const NearestPoint top = nearest_point(parabola, {0.5, 0.25});
  CHECK(top.certified());
  CHECK(top.distance == Approx(0.25).margin(1e-9));
}

TEST_CASE(
    "the nearest point follows translation, rotation and scaling of its curve, and is the same on the reversed curve",
    "[collision]") {
  Sequence random(7);
  for (const HardCurve& curve : hard_curves()) {
    if (curve.tolerance > 1e-9) continue;
    const StrokeElement element = prepare_element(curve.control_points);
    const double angle = random.between(0.0, 2.0 * std::numbers::pi), scale = random.between(0.1, 10.0);
    const Point offset = element.size() * random.point(-3.0, 3.0);
    Eigen::Matrix2d turn;
    turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    const auto map = [&](const Point& point) { return Point(offset + scale * (turn * point)); };
    std::vector<Point> mapped, reversed(curve.control_points.rbegin(), curve.control_points.rend());
    for (const Point& point : curve.control_points) mapped.push_back(map(point));
    const StrokeElement other = prepare_element(mapped), backwards = prepare_element(reversed);
    double worst = 0.0;
    for (const Point& query : hard_queries(curve)) {
      const double distance = nearest_point(element, query).distance;
      const double allowance = 1e-9 * element.size() + 1e-14 * distance;
      worst = std::max(worst, std::abs(nearest_point(other, map(query)).distance / scale - distance) / allowance);
      worst = std::max(worst, std::abs(nearest_point(backwards, query).distance - distance) / allowance);
    }
    INFO(curve.name);
    if (element.size() > 0.0) CHECK(worst <= 1.0);
  }
}

TEST_CASE("the nearest point is finite for every query and every element", "[collision]") {
  const double values[] = {0.0,   -0.0,  5e-324,  1e-310,   1e-200,    1.0,         -1e8,
                           1e154, 1e200, 1.7e308, infinity, -infinity, not_a_number};
  std::vector<HardCurve> curves = hard_curves();
  for (const double size : {5e-324, 1e-310, 1e-200, 1e-170, 1e-100, 1e100}) {
    curves.push_back({"line of length " + std::to_string(std::log10(size)), {{0, 0}, {size, size}}});
    curves.push_back(
        {"curve of size " + std::to_string(std::log10(size)), {{0, 0}, {size, 0}, {0, size}, {size, size}}});
  }
  for (const HardCurve& curve : curves) {
    const StrokeElement element = prepare_element(curve.control_points);
    int wrong = 0;
    for (const auto method : {NearestPointMethod::exact, NearestPointMethod::wang2006}) {
      for (const double x : values) {
        for (const double y : values) {
          const NearestPoint found = nearest_point(element, {x, y}, {method, 1e-9});
          const bool usable = found.point.allFinite() && found.tangent.allFinite() && found.parameter >= 0.0 &&
                              found.parameter <= 1.0 && !std::isnan(found.distance);
          const bool lost = std::isinf(found.distance) && found.parameter == 0.0 && !found.certified();
          wrong += !usable || (!(std::isfinite(x) && std::isfinite(y)) && !lost);
        }
      }
    }
    INFO(curve.name);
    CHECK(wrong == 0);
  }
}

TEST_CASE("over hundreds of thousands of random queries no sample is nearer than the nearest point", "[collision]") {
  Sequence random(99);
  double worst_against_samples = -infinity, worst_against_reference = -infinity;
  int uncertified = 0;
  const std::size_t before = calligraphy_test::allocations();
  std::size_t own = 0;
  for (int i = 0; i < fuzz_queries; ++i) {
    std::array<Point, 5> points;
    const std::size_t count = 3 + static_cast<std::size_t>(3.0 * random.next());
    for (Point& point : points) point = random.point(0.0, 1.0);
    if (i % 5 == 0) points[1] = points[0];
    if (i % 7 == 0) points[count - 2] = points[count - 1];
    if (i % 11 == 0) points[2] = points[1] + 1e-9 * random.point(-1.0, 1.0);
    const StrokeElement element = prepare_element(std::span(points.data(), count));
    const Point query = random.point(-0.5, 1.5);
    const NearestPoint found = nearest_point(element, query);
    uncertified += !found.certified();
    for (int k = 0; k <= 48; ++k) {
      worst_against_samples =
          std::max(worst_against_samples, found.distance - (element.point(k / 48.0) - query).norm());
    }
    if (i % 200 == 0) {
      const std::size_t outside = calligraphy_test::allocations();
      const auto expected =
          ReferenceCurve({points.begin(), points.begin() + static_cast<std::ptrdiff_t>(count)}).nearest(query);
      worst_against_reference =
          std::max(worst_against_reference, static_cast<double>(std::abs(found.distance - expected.distance)));
      own += calligraphy_test::allocations() - outside;
    }
  }
  CHECK(worst_against_samples <= 1e-12);
  CHECK(worst_against_reference <= 1e-9);
  CHECK(uncertified == 0);
  CHECK(calligraphy_test::allocations() - before - own == 0);
}

TEST_CASE("an element that is not finite, or too large to square, rejects every query", "[collision]") {
  const std::vector<std::vector<Point>> unusable = {
      {{0, 0}, {not_a_number, 0}},
      {{infinity, 0}, {0, 0}},
      {{0, 0}, {1, 1}, {-infinity, 0}, {1, 0}},
      {{not_a_number, 0}, {1, 1}, {2, 0}},
      {{1.7e308, 0}, {-1.7e308, 0}, {0, 1}, {1, 1}, {0, 0}},
      {{1e-309, -1e-310}, {1e-310, 1e160}, {1e-41, 0.3}},
  };
  for (const std::vector<Point>& points : unusable) {
    const StrokeElement element = prepare_element(points);
    for (const auto method : {NearestPointMethod::exact, NearestPointMethod::tracked, NearestPointMethod::sampled,
                              NearestPointMethod::wang2006}) {
      const NearestPoint found = nearest_point(element, {0.3, 0.4}, {.method = method});
      CHECK(found.status == NearestPointStatus::not_finite);
      CHECK(std::isinf(found.distance));
      CHECK((found.point.allFinite() && found.tangent.allFinite()));
      CHECK(found.parameter == 0.0);
    }
    CHECK(element.parameter_at(0.5) == 1.0);
  }
}
