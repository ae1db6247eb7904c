// Properties of nearest points on any curve: they follow its transformations, and are reproducible.
#include "../catch.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include <calligraphy/collision/stroke_tracker.hpp>

#include "../hard_cases.hpp"
#include "../nearest_point_oracle.hpp"

using namespace calligraphy;
using calligraphy_test::hard_curves;
using calligraphy_test::hard_queries;
using calligraphy_test::HardCurve;
using calligraphy_test::NearestPointOracle;
using calligraphy_test::Sequence;

namespace {

using calligraphy_test::all_methods;
using calligraphy_test::certified_methods;

std::vector<Point> mapped(const std::vector<Point>& points, const auto& map) {
  std::vector<Point> images;
  for (const Point& point : points) images.push_back(map(point));
  return images;
}

std::vector<Point> reversed(const std::vector<Point>& points) { return {points.rbegin(), points.rend()}; }

/// The same curve, elevated by one degree.
std::vector<Point> elevated(const std::vector<Point>& points) {
  std::vector<Point> result = {points.front()};
  const auto n = static_cast<double>(points.size());
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double share = static_cast<double>(i) / n;
    result.push_back(share * points[i - 1] + (1.0 - share) * points[i]);
  }
  result.push_back(points.back());
  return result;
}

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

bool same_bits(const NearestPoint& a, const NearestPoint& b) {
  return same_bits(a.parameter, b.parameter) && same_bits(a.point.x(), b.point.x()) &&
         same_bits(a.point.y(), b.point.y()) && same_bits(a.distance, b.distance) &&
         same_bits(a.tangent.x(), b.tangent.x()) && same_bits(a.tangent.y(), b.tangent.y()) && a.status == b.status;
}

/// Error of the parameter for the query to the original curve, relative to what is permitted, which includes the
/// rounding of a transformation of both.
double share_of_allowance(const NearestPointOracle& oracle, const Point& query, double parameter, double rounding) {
  const auto bounds = oracle.nearest(query, parameter);
  const long double error = oracle.distance(query, parameter) - bounds.least;
  const double allowed = oracle.allowance(query, static_cast<double>(bounds.found)) + rounding;
  return static_cast<double>(error) / allowed;
}

/// Curves that are their own mirror image in the axis x = 0, to the last bit.
std::vector<std::vector<Point>> mirrored_curves() {
  std::vector<std::vector<Point>> curves = {{{-0.5, 0}, {-0.5, 1}, {0.5, 1}, {0.5, 0}},
                                            {{-0.5, 0}, {1.0, 1}, {-1.0, 1}, {0.5, 0}},
                                            {{-1, 0}, {0, 1}, {1, 0}},
                                            {{-1, 0.25}, {-0.25, -1}, {0, 2}, {0.25, -1}, {1, 0.25}}};
  Sequence random(31);
  for (int i = 0; i < 60; ++i) {
    const int inner = i % 3;
    std::vector<Point> curve = {random.point(-1.0, 1.0)};
    if (inner > 0) curve.push_back(random.point(-1.0, 1.0));
    if (inner != 1) curve.emplace_back(0.0, random.between(-1.0, 1.0));
    if (inner > 0) curve.emplace_back(-curve[1].x(), curve[1].y());
    curve.emplace_back(-curve[0].x(), curve[0].y());
    curves.push_back(curve);
  }
  return curves;
}

}  // namespace

TEST_CASE("the nearest point follows its curve through translation, rotation, scaling and reflection", "[collision]") {
  Sequence random(7);
  for (const HardCurve& curve : hard_curves()) {
    if (curve.tolerance > 1e-9) continue;
    const NearestPointOracle oracle(curve.control_points);
    const double angle = random.between(0.0, 2.0 * std::numbers::pi), scale = random.between(0.1, 10.0);
    const Point offset = oracle.size() * random.point(-3.0, 3.0);
    Eigen::Matrix2d turn;
    turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    if (random.next() < 0.5) turn.col(0) = -turn.col(0);
    const auto map = [&](const Point& point) { return Point(offset + scale * (turn * point)); };
    const StrokeElement image = prepare_element(mapped(curve.control_points, map));
    double worst = 0.0, furthest = 0.0;
    for (const Point& query : hard_queries(curve)) {
      // Rounding moves the image of a point by this much, measured on the original curve.
      const double rounding = 1e-15 * (query.cwiseAbs().maxCoeff() + offset.cwiseAbs().maxCoeff() / scale);
      for (const NearestPointMethod method : certified_methods) {
        const NearestPoint found = nearest_point(image, map(query), {method}, {}, random.next());
        worst = std::max(worst, share_of_allowance(oracle, query, found.parameter, rounding));
        const double distance = static_cast<double>(oracle.distance(query, found.parameter));
        furthest = std::max(
            furthest, std::abs(found.distance / scale - distance) / (oracle.allowance(query, distance) + rounding));
      }
    }
    INFO(curve.name);
    CHECK(worst <= 1.0);
    CHECK(furthest <= 1.0);
  }
}

TEST_CASE("the nearest point stays the same when its curve is reversed or elevated in degree", "[collision]") {
  Sequence random(8);
  for (const HardCurve& curve : hard_curves()) {
    const NearestPointOracle oracle(curve.control_points);
    const StrokeElement backwards = prepare_element(reversed(curve.control_points));
    const bool can_rise = curve.control_points.size() < 5;
    const StrokeElement higher = prepare_element(can_rise ? elevated(curve.control_points) : curve.control_points);
    double worst = 0.0;
    for (const Point& query : hard_queries(curve)) {
      const double rounding = 1e-15 * (query.cwiseAbs().maxCoeff() + oracle.size() + curve.control_points[0].norm());
      for (const NearestPointMethod method : certified_methods) {
        const double back = nearest_point(backwards, query, {method}, {}, random.next()).parameter;
        const double high = nearest_point(higher, query, {method}, {}, random.next()).parameter;
        worst = std::max(worst, share_of_allowance(oracle, query, 1.0 - back, rounding));
        worst = std::max(worst, share_of_allowance(oracle, query, high, rounding));
      }
    }
    INFO(curve.name);
    CHECK(worst <= 1.0);
  }
}

TEST_CASE("the nearest point of a curve is the nearer one of those of its two parts", "[collision]") {
  Sequence random(9);
  for (const HardCurve& curve : hard_curves()) {
    const StrokeElement element = prepare_element(curve.control_points);
    const NearestPointOracle oracle(curve.control_points);
    double worst = 0.0;
    for (const Point& query : hard_queries(curve)) {
      const double cut = random.next();
      for (const NearestPointMethod method : certified_methods) {
        const double first = nearest_point(element, query, {method}, {0.0, cut}, random.next()).distance;
        const double second = nearest_point(element, query, {method}, {cut, 1.0}, random.next()).distance;
        const double whole = nearest_point(element, query, {method}, {}, random.next()).distance;
        const double allowed = 2.0 * oracle.allowance(query, whole);
        worst = std::max(worst, allowed > 0.0 ? std::abs(std::min(first, second) - whole) / allowed : 0.0);
      }
    }
    INFO(curve.name);
    CHECK(worst <= 1.0);
  }
}

TEST_CASE("a curve scaled by a power of two or moved without rounding has the same nearest points to the last bit",
          "[collision]") {
  Sequence random(10);
  int different = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto on_grid = [&] { return Point((8.0 * random.point(0.0, 1.0)).array().round() / 8.0); };
    std::vector<Point> points(2 + static_cast<std::size_t>(4.0 * random.next()));
    for (Point& point : points) point = on_grid();
    const Point query = 2.0 * on_grid() - Point(0.5, 0.5);
    const double scale = std::exp2(std::round(random.between(-40.0, 26.0)));
    const Point offset = (1e6 * random.point(-1.0, 1.0)).array().round();
    const auto map = [&](const Point& point) { return Point(scale * (point + offset)); };
    const StrokeElement element = prepare_element(points), image = prepare_element(mapped(points, map));
    const double start = random.next();
    for (const NearestPointMethod method :
         {NearestPointMethod::exact, NearestPointMethod::tracked, NearestPointMethod::sampled}) {
      const NearestPoint here = nearest_point(element, query, {method}, {}, start);
      const NearestPoint there = nearest_point(image, map(query), {method}, {}, start);
      different += !same_bits(here.parameter, there.parameter) || here.status != there.status;
      different += element.curve() && !same_bits(scale * here.distance, there.distance);
    }
  }
  CHECK(different == 0);
}

TEST_CASE("of two equally near points of a symmetric curve the first is returned", "[collision]") {
  Sequence random(11);
  int second = 0, ties = 0;
  for (const std::vector<Point>& curve : mirrored_curves()) {
    const NearestPointOracle oracle(curve);
    for (int i = 0; i < 64; ++i) {
      const Point query(0.0, i < 32 ? i / 8.0 - 2.0 : random.between(-2.0, 2.0));
      const double scale = std::exp2(std::round(random.between(-30.0, 20.0)));
      const Point offset(0.0, i % 2 == 0 ? 0.0 : std::round(random.between(-4.0, 4.0)));
      const auto map = [&](const Point& point) { return Point(scale * (point + offset)); };
      if (((mapped(curve, map)[0] / scale - offset) - curve[0]).norm() > 0.0) continue;  // rounded by the translation
      const StrokeElement element = prepare_element(mapped(curve, map));
      for (const NearestPointMethod method : certified_methods) {
        const double parameter = nearest_point(element, map(query), {method}, {}, random.next()).parameter;
        second += parameter > 0.5 + 1e-3;
        ties += parameter < 0.5 - 1e-3;
      }
    }
  }
  CHECK(second == 0);
  CHECK(ties > 1000);
}

TEST_CASE("of two equally near elements the tracker returns the first, however the pen came there", "[collision]") {
  Sequence random(12);
  int second = 0, ties = 0;
  for (int i = 0; i < 300; ++i) {
    // A limb on the right, and its mirror image on the left.
    std::vector<Point> right(2 + static_cast<std::size_t>(4.0 * random.next())), left;
    for (Point& point : right) point = random.point(0.0, 1.0) + Point(0.1, 0.0);
    for (const Point& point : right) left.emplace_back(-point.x(), point.y());
    const StrokeElement elements[] = {prepare_element(right), prepare_element(left)};
    StrokeTracker tracker(elements);
    for (int k = 0; k < 20; ++k) {
      const Point tie(0.0, random.between(-1.0, 2.0));
      // Straight away from a closest point the distances change by exactly the distance travelled.
      const Point before = k % 2 == 0 ? random.point(-1.0, 1.0) : Point(0.1 * random.point(-1.0, 0.0));
      tracker.update(before);
      const StrokePoint from_there = tracker.update(tie);
      tracker.update(tie + random.between(0.0, 0.5) * (tie - from_there.closest.point));
      second += tracker.update(tie).element != 0;
      second += from_there.element != 0;
      ++ties;
    }
  }
  INFO(ties << " ties");
  CHECK(second == 0);
}

TEST_CASE("the same query has the same nearest point to the last bit, alone and in a batch, by every method",
          "[collision]") {
  for (const HardCurve& curve : hard_curves()) {
    const StrokeElement element = prepare_element(curve.control_points), other = prepare_element(curve.control_points);
    const std::vector<Point> queries = hard_queries(curve, 100);
    std::vector<NearestPoint> batch(queries.size());
    int different = 0;
    for (const NearestPointMethod method : all_methods) {
      NearestPointOptions options;
      options.method = method;
      nearest_points(element, queries, batch, options);
      for (std::size_t i = queries.size(); i-- > 0;) {  // in another order
        different += !same_bits(batch[i], nearest_point(other, queries[i], options));
        nearest_points(element, std::span(queries).subspan(i, 1), std::span(batch).subspan(i, 1), options);
        different += !same_bits(batch[i], nearest_point(other, queries[i], options));
      }
    }
    INFO(curve.name);
    CHECK(different == 0);
  }
}

TEST_CASE("a range outside [0, 1], reversed or not finite is clamped", "[collision]") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  struct Case {
    calligraphy::ParameterRange given, meant;
  };
  const std::vector<Case> cases = {{{-1.0, 2.0}, {0.0, 1.0}},   {{2.0, 3.0}, {1.0, 1.0}},  {{-3.0, -2.0}, {0.0, 0.0}},
                                   {{0.7, 0.3}, {0.7, 0.7}},    {{nan, nan}, {0.0, 1.0}},  {{0.25, nan}, {0.25, 1.0}},
                                   {{nan, 0.25}, {0.0, 0.25}},  {{-inf, inf}, {0.0, 1.0}}, {{inf, -inf}, {1.0, 1.0}},
                                   {{0.25, 1e300}, {0.25, 1.0}}};
  for (const HardCurve& curve : hard_curves()) {
    const StrokeElement element = prepare_element(curve.control_points);
    const Point query = curve.control_points.front() + element.size() * Point(0.3, 0.2);
    for (const NearestPointMethod method : {NearestPointMethod::exact, NearestPointMethod::tracked,
                                            NearestPointMethod::sampled, NearestPointMethod::wang2006}) {
      for (const Case& each : cases) {
        INFO(curve.name << ", method " << static_cast<int>(method) << ", " << each.given.begin << " to "
                        << each.given.end);
        const NearestPoint given = nearest_point(element, query, {.method = method}, each.given);
        const NearestPoint meant = nearest_point(element, query, {.method = method}, each.meant);
        CHECK(given.parameter == meant.parameter);
        CHECK(given.point == meant.point);
        CHECK(given.status == meant.status);
      }
    }
  }
}

TEST_CASE("options out of range and a start that is not finite still find the nearest point", "[collision]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const HardCurve& curve : hard_curves()) {
    const StrokeElement element = prepare_element(curve.control_points);
    const Point query = curve.control_points.front() + element.size() * Point(0.3, 0.2);
    const double least = nearest_point(element, query).distance;
    INFO(curve.name);
    for (const double tolerance : {0.0, -1.0, nan}) {
      for (const NearestPointMethod method : {NearestPointMethod::exact, NearestPointMethod::tracked}) {
        const NearestPoint found = nearest_point(element, query, {.method = method, .tolerance = tolerance});
        CHECK(std::abs(found.distance - least) <= 1e-9 * element.size());
      }
    }
    for (const double start : {nan, 1e300, -1e300}) {
      const NearestPoint found = nearest_point(element, query, {.method = NearestPointMethod::tracked}, {}, start);
      CHECK(std::abs(found.distance - least) <= 1e-9 * element.size());
      CHECK(found.certified());
    }
    for (const int samples : {-1, 0, 1000}) {
      const NearestPoint found =
          nearest_point(element, query, {.method = NearestPointMethod::sampled, .samples = samples, .refinements = 99});
      CHECK(found.parameter >= 0.0);
      CHECK(found.parameter <= 1.0);
    }
  }
}

TEST_CASE("a batch processes as many queries as both spans hold", "[collision]") {
  const std::vector<Point> bend = {{0.0, 0.0}, {0.01, 0.02}, {0.02, 0.02}, {0.03, 0.0}},
                           line = {{0.0, 0.0}, {0.03, 0.0}};
  const std::vector<Point> queries(20, Point(0.01, 0.01));
  for (const std::vector<Point>& points : {bend, line}) {
    const StrokeElement element = prepare_element(points);
    std::vector<NearestPoint> results(20);
    for (NearestPoint& result : results) result.distance = -1.0;
    nearest_points(element, queries, std::span(results).first(7));
    CHECK(results[6].distance >= 0.0);
    CHECK(results[7].distance == -1.0);
    nearest_points(element, std::span(queries).first(3), std::span(results).last(13));
    CHECK(results[9].distance >= 0.0);
    CHECK(results[10].distance == -1.0);
  }
}
