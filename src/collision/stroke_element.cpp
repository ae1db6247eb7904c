#include <calligraphy/collision/stroke_element.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace calligraphy {
namespace {

constexpr std::array<std::array<double, 5>, 5> binomial = {
    {{1, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {1, 2, 1, 0, 0}, {1, 3, 3, 1, 0}, {1, 4, 6, 4, 1}}};

/// Length of the derivative relative to the element's size below which its direction is rounding noise.
constexpr double vanishing_slope = 1e-7;

/// So near to the end of a curve that ends without speed, the sign of its derivatives is rounding noise too.
constexpr double at_end = 1e-6;

double speed(const StrokeElement& element, double t) { return element.derivative(t).norm(); }

/// Gauss-Legendre quadrature of the speed with 2 nodes.
double integrate_speed(const StrokeElement& element, double begin, double end) {
  constexpr double node = 0.57735026918962576;
  const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
  return half * (speed(element, middle - half * node) + speed(element, middle + half * node));
}

}  // namespace

Point StrokeElement::point(double t) const noexcept {
  Point sum = Point::Zero();
  for (int k = degree; k >= 1; --k) sum = (sum + coefficients[static_cast<std::size_t>(k - 1)]) * t;
  return origin + size * sum;
}

Point StrokeElement::derivative(double t) const noexcept {
  Point sum = Point::Zero();
  for (int k = degree; k >= 1; --k) sum = sum * t + k * coefficients[static_cast<std::size_t>(k - 1)];
  return size * sum;
}

Point StrokeElement::tangent(double t) const noexcept {
  if (!(size > 0.0)) return Point::Zero();
  // Where the first derivative vanishes, the next one that does not gives the direction: the curve leaves its start
  // along +B'' and arrives at its end along -B''. Between them a derivative too short to show a direction still shows
  // on which side of its zero t is; at the zero, a cusp, the curve leaves along +B''.
  std::array<Point, max_curve_degree> row = coefficients;
  Point last = Point::Zero();
  double sign = 1.0;
  for (int order = 1; order <= degree; ++order) {
    for (int k = 0; k <= degree - order; ++k) {
      const auto from = static_cast<std::size_t>(k + (order > 1 ? 1 : 0));
      row[static_cast<std::size_t>(k)] = (k + 1) * row[from];
    }
    Point value = Point::Zero();
    for (int k = degree - order; k >= 0; --k) value = value * t + row[static_cast<std::size_t>(k)];
    if (t > 1.0 - at_end ? order > 1 : t > 0.0 && last.dot(value) < 0.0) sign = -sign;
    if (value.norm() > vanishing_slope) return (sign * value).normalized();
    last = value;
  }
  return Point::Zero();
}

double StrokeElement::arc_length(double t) const noexcept {
  if (degree == 1) return t * length();
  const double scaled = std::clamp(t, 0.0, 1.0) * arc_intervals;
  const int interval = std::min(static_cast<int>(scaled), arc_intervals - 1);
  const auto i = static_cast<std::size_t>(interval);
  return arc[i] + (scaled - interval) * (arc[i + 1] - arc[i]);
}

double StrokeElement::parameter_at(double arc_length) const noexcept {
  if (!(arc_length > 0.0)) return 0.0;
  if (arc_length >= length()) return 1.0;
  if (degree == 1) return arc_length / length();
  const auto above = std::upper_bound(arc.begin() + 1, arc.end() - 1, arc_length);
  const double width = *above - *(above - 1);
  const double share = width > 0.0 ? (arc_length - *(above - 1)) / width : 0.0;
  return (static_cast<double>(above - arc.begin() - 1) + share) / arc_intervals;
}

StrokeElement prepare_element(std::span<const Point> control_points) noexcept {
  StrokeElement element;
  element.degree = static_cast<int>(control_points.size()) - 1;
  element.origin = control_points[0];
  Point low = control_points[0], high = control_points[0];
  for (const Point& point : control_points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  element.size = std::hypot(high.x() - low.x(), high.y() - low.y());
  if (!(element.size > 0.0)) return element;

  const auto n = static_cast<std::size_t>(element.degree);
  std::array<Point, max_curve_degree + 1> difference;
  for (std::size_t i = 0; i <= n; ++i) difference[i] = (control_points[i] - element.origin) / element.size;
  for (std::size_t k = 1; k <= n; ++k) {
    for (std::size_t i = 0; i + k <= n; ++i) difference[i] = difference[i + 1] - difference[i];
    element.coefficients[k - 1] = binomial[n][k] * difference[0];
  }
  for (std::size_t i = 1; i <= n; ++i) {
    for (std::size_t k = 1; k <= n; ++k) {
      element.slope_of_square[i + k - 1] +=
          static_cast<double>(k) * element.coefficients[i - 1].dot(element.coefficients[k - 1]);
    }
  }
  if (element.degree == 1) {
    for (std::size_t i = 0; i < element.arc.size(); ++i) {
      element.arc[i] = element.size * static_cast<double>(i) / StrokeElement::arc_intervals;
    }
    return element;
  }
  for (int i = 0; i < StrokeElement::arc_intervals; ++i) {
    const double begin = static_cast<double>(i) / StrokeElement::arc_intervals;
    const double end = static_cast<double>(i + 1) / StrokeElement::arc_intervals;
    element.arc[static_cast<std::size_t>(i + 1)] =
        element.arc[static_cast<std::size_t>(i)] + integrate_speed(element, begin, end);
  }
  return element;
}

}  // namespace calligraphy
