// The prepared element against long double: points, tangents where the derivative vanishes, arc length and its inverse.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <calligraphy/collision/nearest_point.hpp>
#include <calligraphy/collision/stroke_element.hpp>

#include "../hard_cases.hpp"
#include "../reference_curve.hpp"

using namespace calligraphy;
using calligraphy_test::hard_curves;
using calligraphy_test::HardCurve;
using calligraphy_test::ReferenceCurve;

namespace {

StrokeElement element_through(std::vector<Point> points) { return prepare_element(points); }

bool same_direction(const Point& a, const Point& b) { return (a - b.normalized()).norm() < 1e-6; }

}  // namespace

TEST_CASE("points and derivatives of an element are those of its control points", "[collision]") {
  for (const HardCurve& curve : hard_curves()) {
    const StrokeElement element = prepare_element(curve.control_points);
    const ReferenceCurve reference(curve.control_points);
    double worst = 0.0;
    for (int i = 0; i <= 40; ++i) {
      const double t = i / 40.0;
      const auto at = reference.point(t), slope = reference.derivative(t);
      worst =
          std::max(worst, (element.point(t) - Point(static_cast<double>(at[0]), static_cast<double>(at[1]))).norm());
      worst = std::max(
          worst, (element.derivative(t) - Point(static_cast<double>(slope[0]), static_cast<double>(slope[1]))).norm());
    }
    INFO(curve.name);
    CHECK(worst <= 1e-13 * element.size() + (curve.tolerance > 1e-9 ? 1e-7 : 0.0));
  }
}

TEST_CASE("tangents are unit vectors along the derivative", "[collision]") {
  for (const HardCurve& curve : hard_curves()) {
    const StrokeElement element = prepare_element(curve.control_points);
    double worst = 0.0;
    for (int i = 0; i <= 1000; ++i) {
      const Point tangent = element.tangent(i / 1000.0), slope = element.derivative(i / 1000.0);
      if (element.size() > 0.0) worst = std::max(worst, std::abs(tangent.norm() - 1.0));
      if (slope.norm() > 1e-3 * element.size()) worst = std::max(worst, (tangent - slope.normalized()).norm());
    }
    INFO(curve.name);
    CHECK(worst < 1e-9);
  }
}

TEST_CASE("where the derivative vanishes the tangent is the limit of the writing direction", "[collision]") {
  CHECK(same_direction(element_through({{0, 0}, {0, 0}, {1, 1}, {1, 0}}).tangent(0.0), {1, 1}));
  CHECK(same_direction(element_through({{0, 0}, {0.2, 1}, {1, 0}, {1, 0}}).tangent(1.0), {0.8, -1}));
  CHECK(same_direction(element_through({{0, 0}, {0, 0}, {0, 0}, {1, 0.5}}).tangent(0.0), {1, 0.5}));
  CHECK(same_direction(element_through({{0, 0}, {1, 0.5}, {1, 0.5}, {1, 0.5}}).tangent(1.0), {1, 0.5}));
  CHECK(same_direction(element_through({{0, 0}, {0, 0}, {0.5, 1}, {1, 0}, {1, 0}}).tangent(0.0), {0.5, 1}));
  CHECK(same_direction(element_through({{0, 0}, {0, 0}, {0.5, 1}, {1, 0}, {1, 0}}).tangent(1.0), {0.5, -1}));
  CHECK(element_through({{0.3, 0.7}, {0.3, 0.7}, {0.3, 0.7}, {0.3, 0.7}}).tangent(0.5) == Point(0, 0));
  CHECK(element_through({{0.3, 0.7}, {0.3, 0.7}}).tangent(0.0) == Point(0, 0));
}

TEST_CASE("the tangent does not flip next to a vanishing derivative", "[collision]") {
  const std::vector<std::vector<Point>> curves = {
      {{0, 0}, {0, 0}, {1, 1}, {1, 0}},       {{0, 0}, {0.2, 1}, {1, 0}, {1, 0}},
      {{0, 0}, {1, 0.5}, {1, 0.5}, {1, 0.5}}, {{0, 0}, {0, 0}, {0, 0}, {1, 0.5}},
      {{0, 0}, {0, 0}, {1, 0.5}, {1, 0.5}},   {{0, 0}, {0, 0}, {0.5, 1}, {1, 0}, {1, 0}}};
  for (const auto& curve : curves) {
    const StrokeElement element = prepare_element(curve);
    for (int digits = 2; digits <= 15; ++digits) {
      const double step = std::pow(10.0, -digits);
      INFO("step " << step);
      CHECK(element.tangent(step).dot(element.tangent(0.0)) > 0.9);
      CHECK(element.tangent(1.0 - step).dot(element.tangent(1.0)) > 0.9);
    }
  }
}

TEST_CASE("the curvature is the turn of the derivative per arc length, and finite everywhere", "[collision]") {
  constexpr double h = 1e-6;
  for (const HardCurve& curve : hard_curves()) {
    const StrokeElement element = prepare_element(curve.control_points);
    const ReferenceCurve reference(curve.control_points);
    const double size = element.size();
    double worst = 0.0;
    bool is_finite = true;
    for (int i = 0; i <= 1000; ++i) {
      const double t = i / 1000.0, curvature = element.curvature(t);
      is_finite = is_finite && std::isfinite(curvature);
      const auto a = reference.derivative(t - h), b = reference.derivative(t + h);
      const double arc = 2.0 * h * element.derivative(t).norm();
      if (!(arc > 0.1 * h * size)) continue;
      const double turn = static_cast<double>(std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]));
      worst = std::max(worst, size * std::abs(curvature - turn / arc) / (1.0 + size * std::abs(turn / arc)));
    }
    INFO(curve.name);
    CHECK(is_finite);
    CHECK(worst < 1e-6);
  }
}

TEST_CASE("the curvature of a quarter of a circle is 1/r, to the left", "[collision]") {
  constexpr double r = 0.02, k = 0.5522847498307936 * r;
  const StrokeElement left = element_through({{r, 0}, {r, k}, {k, r}, {0, r}});
  const StrokeElement right = element_through({{0, r}, {k, r}, {r, k}, {r, 0}});
  double worst = 0.0, turn = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double t = (i + 0.5) / 1000.0;
    worst = std::max(worst, std::abs(r * left.curvature(t) - 1.0));
    turn += left.curvature(t) * left.derivative(t).norm() / 1000.0;
    CHECK(right.curvature(1.0 - t) == Approx(-left.curvature(t)));
  }
  CHECK(left.curvature(0.0) == Approx(2.0 / 3.0 * (r - k) / (k * k)));  // of any cubic, from its control points
  CHECK(worst < 0.022);                                                 // least at the ends, by the line above
  CHECK(turn == Approx(std::acos(0.0)));
}

TEST_CASE("the curvature of a line and of a point, and where the derivative vanishes, is 0", "[collision]") {
  CHECK(element_through({{0, 0}, {3, 4}}).curvature(0.5) == 0.0);
  CHECK(element_through({{3, 4}, {3, 4}, {3, 4}}).curvature(0.5) == 0.0);
  CHECK(element_through({{0, 0}, {0, 0}, {1, 1}, {1, 0}}).curvature(0.0) == 0.0);
  CHECK(element_through({{0, 0}, {1, 1}, {0, 1}, {1, 0}}).curvature(0.5) == 0.0);  // a cusp
  CHECK(element_through({}).curvature(0.5) == 0.0);
}

TEST_CASE("arc length is exact at its nodes and within its bound between them", "[collision]") {
  for (const HardCurve& curve : hard_curves()) {
    const StrokeElement element = prepare_element(curve.control_points);
    const ReferenceCurve reference(curve.control_points);
    double worst = 0.0;
    for (int i = 0; i <= 40; ++i) {
      const double t = i / 40.0;
      worst = std::max(worst, std::abs(element.arc_length(t) - static_cast<double>(reference.arc_length(t, 400))));
    }
    INFO(curve.name << ": " << worst / element.size());
    CHECK(worst <= 3e-3 * element.size());  // as the header states: (1/32)^2 / 8 of |B''| <= 24 sizes for a quartic
  }
}

TEST_CASE("arc length increases with the parameter, and parameter_at inverts it", "[collision]") {
  for (const HardCurve& curve : hard_curves()) {
    const StrokeElement element = prepare_element(curve.control_points);
    int falls = 0;
    double worst = 0.0, last_arc = 0.0, last_parameter = 0.0;
    for (int i = 0; i <= 500; ++i) {
      const double arc = element.arc_length(i / 500.0);
      falls += arc < last_arc;
      last_arc = arc;
      const double parameter = element.parameter_at(element.length() * i / 500.0);
      falls += parameter < last_parameter || parameter > 1.0;
      last_parameter = parameter;
      worst = std::max(worst, std::abs(element.arc_length(parameter) - element.length() * i / 500.0));
    }
    INFO(curve.name);
    CHECK(falls == 0);
    CHECK(worst <= 1e-12 * element.length());
    CHECK(element.parameter_at(-1.0) == 0.0);
    CHECK(element.arc_length(0.0) == 0.0);
    CHECK(element.arc_length(1.0) == element.length());
    if (element.size() > 0.0) CHECK(element.parameter_at(2.0 * element.length()) == 1.0);
    CHECK(element.parameter_at(std::nan("")) == 0.0);
    for (const double below : {-1.0, -1e300, -std::numeric_limits<double>::infinity(), std::nan("")}) {
      CHECK(element.arc_length(below) == 0.0);
    }
    for (const double above : {2.0, 1e300, std::numeric_limits<double>::infinity()}) {
      CHECK(element.arc_length(above) == element.length());
    }
  }
}

TEST_CASE("a curve from 1e-290 m to 1e150 m has the length of its shape, scaled", "[collision]") {
  const std::vector<Point> shape = {{0.0, 0.0}, {0.3, 0.5}, {0.6, 0.5}, {0.9, 0.0}};
  const double length = prepare_element(shape).length();
  for (const double scale : {1e-290, 1e-200, 1e-160, 1e-12, 1e12, 1e100, 1e150}) {
    const StrokeElement element = prepare_element(calligraphy_test::moved(shape, scale, Point::Zero()));
    INFO(scale);
    CHECK(element.length() / scale == Approx(length).epsilon(1e-9));
  }
}

TEST_CASE("an invalid number of control points gives an element that rejects every query", "[collision]") {
  for (const std::size_t count : {0u, 1u, 6u, 100u}) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < count; ++i) points.emplace_back(static_cast<double>(i), static_cast<double>(i * i));
    const StrokeElement element = prepare_element(points);
    INFO(count);
    CHECK(std::isnan(element.length()));
    CHECK(nearest_point(element, {0.5, 0.5}).status == NearestPointStatus::not_finite);
  }
}
