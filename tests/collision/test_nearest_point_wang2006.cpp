// The subdivision as printed in Wang 2006, sec. 4.3.2: its results, its wrong results, and that it always terminates.
#include "../catch.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <calligraphy/collision/nearest_point.hpp>

#include "../hard_cases.hpp"
#include "../last_interval.hpp"
#include "../nearest_point_oracle.hpp"
#include "../reference_curve.hpp"

using namespace calligraphy;

namespace {

NearestPoint printed(const std::vector<Point>& points, const Point& query, double epsilon = 1e-6) {
  return nearest_point(prepare_element(points), query, {NearestPointMethod::wang2006, epsilon});
}

NearestPoint exact(const std::vector<Point>& points, const Point& query) {
  return nearest_point(prepare_element(points), query);
}

}  // namespace

TEST_CASE("the printed rule stops at once where both children are equally far", "[collision]") {
  const std::vector<Point> arch = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  for (const double epsilon : {1e-3, 1e-6, 1e-9}) {
    CHECK(printed(arch, {0.5, 1.0}, epsilon).point.isApprox(Point(0.5, 0.5625)));
    CHECK(printed(arch, {0.5, 1.0}, epsilon).distance == Approx(0.4375));
  }
  CHECK(exact(arch, {0.5, 1.0}).distance == Approx(0.25));
  CHECK(exact(arch, {0.5, 1.0}).point.isApprox(Point(0.5, 0.75)));

  const std::vector<Point> wave = {{0, 0}, {1, 2}, {3, 3}, {4, 0}};
  CHECK(printed(wave, {1.7890625, 3.046875}).point.isApprox(Point(2.0, 1.40625)));
  CHECK(printed(wave, {1.7890625, 3.046875}).distance == Approx(1.65413).epsilon(1e-5));
  CHECK(exact(wave, {1.7890625, 3.046875}).distance == Approx(1.190654).epsilon(1e-6));
  CHECK(exact(wave, {1.7890625, 3.046875}).parameter == Approx(0.498169).epsilon(1e-5));
}

TEST_CASE("a tie of the printed rule goes to the child with the nearer midpoint", "[collision]") {
  const std::vector<Point> straight = {{0, 0}, {1, 0}, {2, 0}, {3, 0}};
  CHECK(printed(straight, {1.71, 0.3}).distance == Approx(0.3).margin(1e-4));
  CHECK(exact(straight, {1.71, 0.3}).distance == Approx(0.3));
}

TEST_CASE("the printed rule takes the wrong branch on a hook and on a sharp bend", "[collision]") {
  const std::vector<Point> hook = {{0, 0}, {1.2, 0}, {1.3, 0.1}, {0.9, 0.15}};
  CHECK(printed(hook, {0.88, 0.085}).distance == Approx(0.0680074).epsilon(1e-4));
  CHECK(exact(hook, {0.88, 0.085}).distance == Approx(0.0545434).epsilon(1e-6));
  CHECK(exact(hook, {0.88, 0.085}).parameter == Approx(0.352775).epsilon(1e-5));

  const std::vector<Point> bend = {{0.4, 0.9}, {0.7, 0.05}, {0.75, 0.35}, {0.7, 0.65}};
  CHECK(printed(bend, {0.5, 0.7}).distance == Approx(0.2061553).epsilon(1e-4));
  CHECK(exact(bend, {0.5, 0.7}).distance == Approx(0.0241071).epsilon(1e-5));
  CHECK(exact(bend, {0.5, 0.7}).parameter == Approx(0.093316).epsilon(1e-4));
}

TEST_CASE("the printed rule terminates where it would not as printed: far offset, NaN, huge number", "[collision]") {
  std::vector<Point> far = {{0.1, 0.2}, {0.9, 0.1}, {0.3, 0.8}, {0.7, 0.6}};
  for (Point& point : far) point += Point(1e8, 1e8);
  const Point query(1e8 + 0.4, 1e8 + 0.9);
  CHECK(printed(far, query, 1e-9).distance ==
        Approx(static_cast<double>(calligraphy_test::ReferenceCurve(far).nearest(query).distance)).margin(1e-2));
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Point& lost :
       {Point(nan, 0.0), Point(0.0, nan), Point(infinity, 0.0), Point(-infinity, infinity), Point(1e200, 1e200)}) {
    const NearestPoint found = printed(far, lost);
    CHECK(found.parameter == 0.0);
    CHECK(std::isinf(found.distance));
    CHECK_FALSE(found.certified());
  }
}

TEST_CASE("the printed rule never claims a certificate on a curve and never beats the exact result", "[collision]") {
  int certified = 0, wrong = 0, queries = 0;
  double best_gain = 0.0;
  for (const auto& curve : calligraphy_test::hard_curves()) {
    const StrokeElement element = prepare_element(curve.control_points);
    if (element.degree() == 1 || element.size() == 0.0 || curve.tolerance > 1e-9) continue;
    for (const Point& query : calligraphy_test::hard_queries(curve)) {
      const NearestPoint found = nearest_point(element, query, {NearestPointMethod::wang2006, 1e-6});
      // Its point lies between two points of the curve, at most the last step off it: this is tolerated.
      const double gain = nearest_point(element, query).distance - found.distance;
      certified += found.certified();
      wrong += gain < -1e-3 * element.size();
      best_gain = std::max(best_gain, (gain - 1e-12 * found.distance) / element.size());
      ++queries;
    }
  }
  CHECK(certified == 0);
  CHECK(best_gain < 0.3);
  CHECK(wrong > queries / 100);  // this is why it is not the default
}

TEST_CASE("on a line both methods return the foot of the perpendicular", "[collision]") {
  const std::vector<Point> line = {{0.1, 0.2}, {0.9, 0.2}};
  for (const double x : {-1.0, 0.1, 0.35, 0.5, 0.9, 3.0}) {
    const double closest = std::min(std::max(x, 0.1), 0.9);
    CHECK(printed(line, {x, 0.7}).point.isApprox(Point(closest, 0.2)));
    CHECK(exact(line, {x, 0.7}).point.isApprox(Point(closest, 0.2)));
  }
}

TEST_CASE("the printed rule reports where it stopped by an accidental equality", "[collision]") {
  const std::vector<Point> arch = {{0, 0}, {0, 1}, {1, 1}, {1, 0}}, wave = {{0, 0}, {1, 2}, {3, 3}, {4, 0}};
  for (const double epsilon : {1e-3, 1e-6, 1e-9}) {
    CHECK(printed(arch, {0.5, 1.0}, epsilon).status == NearestPointStatus::unsafe_stop);
    CHECK(printed(wave, {1.7890625, 3.046875}, epsilon).status == NearestPointStatus::unsafe_stop);
    // Here it comes near enough to a local nearest point, if not to the global one.
    CHECK(printed({{0, 0}, {1, 0}, {2, 0}, {3, 0}}, {1.71, 0.3}, epsilon).status == NearestPointStatus::approximate);
  }
}

TEST_CASE("every stop of the printed rule that leaves a nearer point in its last interval is reported", "[collision]") {
  int untold = 0, unsafe = 0, told = 0, stops = 0;
  for (const auto& curve : calligraphy_test::hard_curves()) {
    const StrokeElement element = prepare_element(curve.control_points);
    if (!element.curve()) continue;
    const calligraphy_test::NearestPointOracle oracle(curve.control_points);
    for (const Point& query : calligraphy_test::hard_queries(curve, 200)) {
      for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
        const NearestPoint found = nearest_point(element, query, {NearestPointMethod::wang2006, tolerance});
        const auto last = calligraphy_test::last_interval(found.parameter);
        const auto nearest = oracle.nearest(query, found.parameter, last).found;
        const double epsilon = calligraphy_test::wang2006_epsilon(element, query, tolerance);
        const double rounding = 1e-15 * found.distance;  // of the distances compared
        const bool leaves_nearer = nearest < found.distance - epsilon - rounding;
        unsafe += leaves_nearer;
        told += found.status == NearestPointStatus::unsafe_stop;
        untold += leaves_nearer && found.status != NearestPointStatus::unsafe_stop;
        ++stops;
      }
    }
  }
  INFO(stops << " stops, " << told << " told to be unsafe, " << unsafe << " are");
  CHECK(untold == 0);
  CHECK(unsafe > 100);
  CHECK(told <= unsafe + stops / 1000);  // and no others are reported, up to rounding
}
