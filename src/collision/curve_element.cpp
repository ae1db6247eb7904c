#include <calligraphy/collision/detail/curve_element.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "binomial.hpp"
#include "length.hpp"
#include "slope_cells.hpp"

namespace calligraphy {

using detail::SlopeOrdinates;

namespace {

/// Length of the derivative relative to the element's size below which its direction is rounding noise.
constexpr double vanishing_slope = 1e-7;

/// This close to the end of a curve that ends with zero speed, the sign of its derivatives is rounding noise too.
constexpr double at_end = 1e-6;

/// Coefficients or ordinates of one part of g: the factor of q_x, the factor of q_y, or the constant.
using Row = std::array<double, 2 * max_curve_degree>;

/// Converts from the power basis to the Bernstein basis over [0, 1].
template <int Degree>
void to_bernstein(Row& row) {
  for (std::size_t i = 1; i < Degree; ++i) row[i] *= 1.0 / binomial[Degree][i];
  for (std::size_t k = 1; k <= Degree; ++k) {
    for (std::size_t i = Degree; i >= k; --i) row[i] += row[i - 1];
  }
}

/// Divides by t as often as the curve starts with zero speed, and by 1 - t as often as it ends so: there g vanishes for
/// every query, which would leave its sign undecided. The signs inside are preserved; degree elevation preserves the
/// degree.
template <int Degree>
void divide_zeros_out(Row& row, int from_start, int from_end) {
  const int reduced = Degree - from_start - from_end;
  for (int n = Degree; n > Degree - from_start; --n) {
    for (int i = 0; i < n; ++i) {
      row[static_cast<std::size_t>(i)] = row[static_cast<std::size_t>(i + 1)] * n / (i + 1);
    }
  }
  for (int n = Degree - from_start; n > reduced; --n) {
    for (int i = 0; i < n; ++i) row[static_cast<std::size_t>(i)] *= static_cast<double>(n) / (n - i);
  }
  for (int n = reduced; n < Degree; ++n) {
    row[static_cast<std::size_t>(n + 1)] = row[static_cast<std::size_t>(n)];
    for (int i = n; i > 0; --i) {
      const double share = static_cast<double>(i) / (n + 1);
      row[static_cast<std::size_t>(i)] =
          share * row[static_cast<std::size_t>(i - 1)] + (1.0 - share) * row[static_cast<std::size_t>(i)];
    }
  }
}

/// Error of an ordinate relative to the maximum term: five roundings to single precision, plus a margin.
constexpr float noise_share = 8.0F * 0x1p-24F;

/// Contribution of each ordinate of a polynomial over the whole curve to each ordinate over the cells: subdivision is
/// linear.
template <int Degree, std::size_t Count>
constexpr std::array<std::array<double, Count>, Degree + 1> subdivision(int cells) {
  std::array<std::array<double, Count>, Degree + 1> weights = {};
  for (std::size_t unit = 0; unit <= Degree; ++unit) {
    std::array<double, Degree + 1> rest = {};
    rest[unit] = 1.0;
    std::size_t next = 0;
    weights[unit][place_of_ordinate<Count>(next++)] = rest[0];
    // De Casteljau's algorithm splits off one cell after the other.
    for (int left = cells; left > 0; --left) {
      std::array<double, Degree + 1> cell = rest;
      for (std::size_t k = 0; left > 1 && k <= Degree; ++k) {
        cell[k] = rest[0];
        for (std::size_t i = 0; i + k < Degree; ++i) rest[i] += (rest[i + 1] - rest[i]) / left;
      }
      for (std::size_t i = 1; i <= Degree; ++i) weights[unit][place_of_ordinate<Count>(next++)] = cell[i];
    }
    // Unused entries repeat the last ordinate and so show no sign change.
    for (; next < Count; ++next) weights[unit][place_of_ordinate<Count>(next)] = rest[Degree];
  }
  return weights;
}

template <int Degree, std::size_t Count>
float write_ordinates(const Row& row, const std::array<std::array<double, Count>, Degree + 1>& weights,
                      std::array<float, Count>& ordinates) {
  for (std::size_t i = 0; i < Count; ++i) {
    double sum = 0.0;
    for (std::size_t k = 0; k <= Degree; ++k) sum += weights[k][i] * row[k];
    ordinates[i] = static_cast<float>(sum);
  }
  float largest = 0.0F;  // the maximum over the whole curve bounds that over a part
  for (std::size_t k = 0; k <= Degree; ++k) largest = std::max(largest, static_cast<float>(std::abs(row[k])));
  return largest;
}

template <int Degree, std::size_t Count>
void write_parts(const std::array<Row, 3>& parts, const std::array<std::array<double, Count>, Degree + 1>& weights,
                 SlopeOrdinates<Count>& ordinates) {
  ordinates.noise_x = noise_share * write_ordinates<Degree>(parts[0], weights, ordinates.x);
  ordinates.noise_y = noise_share * write_ordinates<Degree>(parts[1], weights, ordinates.y);
  ordinates.noise_constant = noise_share * write_ordinates<Degree>(parts[2], weights, ordinates.constant);
}

template <int Degree>
void prepare_ordinates(CurveElement& curve, int equal_at_start, int equal_at_end) {
  constexpr int degree = 2 * Degree - 1;
  std::array<Row, 3> parts = {};
  parts[2] = curve.slope_of_square;
  for (std::size_t k = 0; k < Degree; ++k) {
    parts[0][k] = -static_cast<double>(k + 1) * curve.coefficients[k].x();
    parts[1][k] = -static_cast<double>(k + 1) * curve.coefficients[k].y();
  }
  for (Row& row : parts) {
    to_bernstein<degree>(row);
    if (equal_at_start + equal_at_end > 2) divide_zeros_out<degree>(row, equal_at_start - 1, equal_at_end - 1);
  }
  static constexpr auto of_whole = subdivision<degree, CurveElement::whole_ordinates>(1);
  static constexpr auto of_cells = subdivision<degree, CurveElement::max_ordinates>(cells_of_degree(Degree));
  write_parts<degree>(parts, of_whole, curve.whole);
  write_parts<degree>(parts, of_cells, curve.ordinates);
}

/// Number of control points equal to the first one and adjacent to it, including itself.
template <typename Iterator>
int equal_run(Iterator begin, Iterator end) {
  const auto other = std::find_if(begin, end, [&](const Point& point) { return point != *begin; });
  return static_cast<int>(other - begin);
}

/// Gauss-Legendre quadrature of the speed with 2 nodes per interval, in units of the size so that squares neither
/// overflow nor underflow.
void prepare_arc(CurveElement& curve) {
  constexpr double node = 0.57735026918962576;
  constexpr double half = 0.5 / CurveElement::arc_intervals;
  const auto speed = [&](double t) { return curve.derivative_per_size(t).norm(); };
  double sum = 0.0;
  for (int i = 0; i < CurveElement::arc_intervals; ++i) {
    const double middle = (2 * i + 1) * half;
    sum += half * (speed(middle - half * node) + speed(middle + half * node));
    curve.arc[static_cast<std::size_t>(i + 1)] = curve.size * sum;
  }
}

}  // namespace

Point CurveElement::point(double t) const noexcept {
  Point sum = Point::Zero();
  for (int k = degree; k >= 1; --k) sum = (sum + coefficients[static_cast<std::size_t>(k - 1)]) * t;
  return origin + size * sum;
}

Point CurveElement::derivative_per_size(double t) const noexcept {
  Point sum = Point::Zero();
  for (int k = degree; k >= 1; --k) sum = sum * t + k * coefficients[static_cast<std::size_t>(k - 1)];
  return sum;
}

Point CurveElement::tangent(double t) const noexcept {
  // Where the first derivative vanishes, the next one that does not gives the direction: the curve leaves its start
  // along +B'' and reaches its end along -B''. In between, a derivative too small to show a direction still shows on
  // which side of its zero t is; at the zero, a cusp, the curve leaves along +B''.
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

double CurveElement::curvature(double t) const noexcept {
  Point first = Point::Zero(), second = Point::Zero();  // derivatives, per size
  for (int k = degree; k >= 1; --k) {
    second = second * t + first;
    first = first * t + k * coefficients[static_cast<std::size_t>(k - 1)];
  }
  const double slope = first.norm();
  if (!(slope > vanishing_slope)) return 0.0;
  return (first.x() * second.y() - first.y() * second.x()) / (slope * slope * slope * size);
}

double CurveElement::arc_length(double t) const noexcept {
  const double scaled = t > 0.0 ? std::min(t, 1.0) * arc_intervals : 0.0;
  const int interval = std::min(static_cast<int>(scaled), arc_intervals - 1);
  const auto i = static_cast<std::size_t>(interval);
  return arc[i] + (scaled - interval) * (arc[i + 1] - arc[i]);
}

double CurveElement::parameter_at(double arc_length) const noexcept {
  const auto above = std::upper_bound(arc.begin() + 1, arc.end() - 1, arc_length);
  const double width = *above - *(above - 1);
  const double share = width > 0.0 ? (arc_length - *(above - 1)) / width : 0.0;
  return (static_cast<double>(above - arc.begin() - 1) + share) / arc_intervals;
}

CurveElement detail::prepare_curve(std::span<const Point> control_points) noexcept {
  CurveElement curve;
  curve.degree = static_cast<int>(control_points.size()) - 1;
  curve.origin = control_points[0];
  Point low = control_points[0], high = control_points[0];
  for (const Point& point : control_points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  curve.size = length(high - low);
  curve.per_size = 1.0 / curve.size;

  const auto n = static_cast<std::size_t>(curve.degree);
  std::array<Point, max_curve_degree + 1> difference;
  for (std::size_t i = 0; i <= n; ++i) difference[i] = (control_points[i] - curve.origin) * curve.per_size;
  for (std::size_t k = 1; k <= n; ++k) {
    for (std::size_t i = 0; i + k <= n; ++i) difference[i] = difference[i + 1] - difference[i];
    curve.coefficients[k - 1] = binomial[n][k] * difference[0];
    curve.min_slope += 1e-5 * curve.coefficients[k - 1].squaredNorm();
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      curve.slope_of_square[i + k + 1] += static_cast<double>(k + 1) * curve.coefficients[i].dot(curve.coefficients[k]);
    }
  }
  curve.cells = cells_of_degree(curve.degree);
  const int at_first = equal_run(control_points.begin(), control_points.end());
  const int at_last = equal_run(control_points.rbegin(), control_points.rend());
  if (curve.degree == 2) prepare_ordinates<2>(curve, at_first, at_last);
  if (curve.degree == 3) prepare_ordinates<3>(curve, at_first, at_last);
  if (curve.degree == 4) prepare_ordinates<4>(curve, at_first, at_last);
  prepare_arc(curve);
  return curve;
}

}  // namespace calligraphy
