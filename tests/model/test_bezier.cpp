// Bezier curves of degree 1 to 4, Wang 2006, sec. 3.3, eq. (1).
#include "../catch.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <calligraphy/model/bezier.hpp>

#include "../hard_cases.hpp"
#include "../reference_curve.hpp"

using namespace calligraphy;
using calligraphy_test::hard_curves;
using calligraphy_test::HardCurve;
using calligraphy_test::ReferenceCurve;

namespace {

/// Calls `check(curve, reference, size, rounding)` for every hard curve of this degree.
template <int Degree, class Check>
void for_each(const Check& check) {
  for (const HardCurve& hard : hard_curves()) {
    if (hard.control_points.size() != Degree + 1) continue;
    Bezier<Degree> curve;
    double largest = 0.0;
    for (std::size_t i = 0; i <= Degree; ++i) {
      curve.control_points[i] = hard.control_points[i];
      largest = std::max(largest, hard.control_points[i].norm());
    }
    INFO(hard.name);
    check(curve, ReferenceCurve(hard.control_points), 64.0 * 2.3e-16 * largest);
  }
}

Point as_point(const ReferenceCurve::Vector& v) { return {static_cast<double>(v[0]), static_cast<double>(v[1])}; }

template <int Degree>
void check_identities() {
  for_each<Degree>([](const Bezier<Degree>& curve, const ReferenceCurve& reference, double rounding) {
    CHECK(curve.point(0.0) == curve.control_points.front());
    CHECK((curve.point(1.0) - curve.control_points.back()).norm() <= rounding);
    CHECK((curve.derivative(0.0) - Degree * (curve.control_points[1] - curve.control_points[0])).norm() <=
          Degree * rounding);
    double point = 0.0, slope = 0.0, halves = 0.0, elevation = 0.0, difference = 0.0;
    for (int i = 0; i <= 20; ++i) {
      const double t = i / 20.0, split_at = 0.05 + 0.9 * t;
      point = std::max(point, (curve.point(t) - as_point(reference.point(t))).norm());
      slope = std::max(slope, (curve.derivative(t) - as_point(reference.derivative(t))).norm());
      const auto [left, right] = curve.split(split_at);
      halves = std::max(halves, (left.point(0.3) - curve.point(0.3 * split_at)).norm());
      halves = std::max(halves, (right.point(0.3) - curve.point(split_at + 0.3 * (1.0 - split_at))).norm());
      halves = std::max(halves, (left.control_points.back() - right.control_points.front()).norm());
      elevation = std::max(elevation, (curve.elevated().point(t) - curve.point(t)).norm());
      // The slope is the limit of a quotient: central difference, exact to (step)^2.
      const ReferenceCurve::Real step = 1e-4L, middle = 0.01L + 0.98L * t;
      const auto after = reference.point(middle + step), before = reference.point(middle - step);
      const Point quotient(static_cast<double>((after[0] - before[0]) / (2 * step)),
                           static_cast<double>((after[1] - before[1]) / (2 * step)));
      difference = std::max(difference, (curve.derivative(static_cast<double>(middle)) - quotient).norm());
    }
    CHECK(point <= rounding);
    CHECK(slope <= 4 * Degree * rounding);
    CHECK(halves <= rounding);
    CHECK(elevation <= rounding);
    std::vector<Point> points(curve.control_points.begin(), curve.control_points.end());
    CHECK(difference <= 1e-6 * calligraphy_test::size_of(points) + 4 * Degree * rounding);
  });
}

}  // namespace

TEST_CASE("the Bezier identities hold for every degree on every hard curve", "[model]") {
  check_identities<1>();
  check_identities<2>();
  check_identities<3>();
  check_identities<4>();
}

TEST_CASE("the quartic is eq. (1) as printed: a sum to 4 with 4!", "[model]") {
  const Bezier<4> curve{{Point(0.1, 0.2), Point(0.4, 0.9), Point(0.5, -0.3), Point(0.8, 1.1), Point(1.0, 0.4)}};
  const auto factorial = [](int n) {
    double product = 1.0;
    for (int i = 2; i <= n; ++i) product *= i;
    return product;
  };
  for (int k = 0; k <= 100; ++k) {
    const double u = k / 100.0;
    Point sum = Point::Zero();
    for (int i = 0; i <= 4; ++i) {
      sum += factorial(4) / (factorial(4 - i) * factorial(i)) * std::pow(1.0 - u, 4 - i) * std::pow(u, i) *
             curve.control_points[static_cast<std::size_t>(i)];
    }
    CHECK((curve.point(u) - sum).norm() < 1e-15);
  }
}

TEST_CASE("a curve stays within the bounding box of its control points", "[model]") {
  for_each<3>([](const Bezier<3>& curve, const ReferenceCurve&, double rounding) {
    Point low = curve.control_points[0], high = low;
    for (const Point& point : curve.control_points) low = low.cwiseMin(point), high = high.cwiseMax(point);
    double outside = 0.0;
    for (int i = 0; i <= 100; ++i) {
      const Point point = curve.point(i / 100.0);
      outside = std::max({outside, (low - point).maxCoeff(), (point - high).maxCoeff()});
    }
    CHECK(outside <= rounding);
  });
}
