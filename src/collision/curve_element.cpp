#include <calligraphy/collision/curve_element.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace calligraphy {
namespace {

constexpr std::array<std::array<double, 8>, 8> binomial = {{{1},
                                                            {1, 1},
                                                            {1, 2, 1},
                                                            {1, 3, 3, 1},
                                                            {1, 4, 6, 4, 1},
                                                            {1, 5, 10, 10, 5, 1},
                                                            {1, 6, 15, 20, 15, 6, 1},
                                                            {1, 7, 21, 35, 35, 21, 7, 1}}};

/// Length of the derivative relative to the element's size below which its direction is rounding noise.
constexpr double vanishing_slope = 1e-7;

/// So near to the end of a curve that ends without speed, the sign of its derivatives is rounding noise too.
constexpr double at_end = 1e-6;

/// Parts of an ordinate: the factors of q_x and q_y, and the constant; the fourth fills the register.
using Parts = Eigen::Array4d;
using PartRow = std::array<Parts, 2 * max_curve_degree>;

/// Of the curve that the coefficients describe, over [0, 1].
PartRow bernstein_ordinates(const CurveElement& curve) {
  const int degree = 2 * curve.degree - 1;
  PartRow row;
  row.fill(Parts::Zero());
  for (int k = 1; k <= curve.degree; ++k) {
    const Point& factor = curve.coefficients[static_cast<std::size_t>(k - 1)];
    Parts& power = row[static_cast<std::size_t>(k - 1)];
    power.head<2>() = -k * factor;
    for (int i = 1; i <= curve.degree; ++i) {
      row[static_cast<std::size_t>(i + k - 1)][2] +=
          k * curve.coefficients[static_cast<std::size_t>(i - 1)].dot(factor);
    }
  }
  const auto last = static_cast<std::size_t>(degree);
  for (std::size_t i = 1; i < last; ++i) row[i] /= binomial[last][i];
  for (std::size_t k = 1; k <= last; ++k) {
    for (std::size_t i = last; i >= k; --i) row[i] += row[i - 1];
  }
  return row;
}

/// Divides by t as often as the curve starts without speed, and by 1 - t as often as it ends so: g is zero there for
/// every query, which would leave its sign open. The signs inside stay, and so does the degree, by elevation.
void divide_zeros_out(PartRow& row, int degree, int at_start, int at_end) {
  const int reduced = degree - at_start - at_end;
  for (int n = degree; n > degree - at_start; --n) {
    for (int i = 0; i < n; ++i) {
      row[static_cast<std::size_t>(i)] = row[static_cast<std::size_t>(i + 1)] * (static_cast<double>(n) / (i + 1));
    }
  }
  for (int n = degree - at_start; n > reduced; --n) {
    for (int i = 0; i < n; ++i) row[static_cast<std::size_t>(i)] *= static_cast<double>(n) / (n - i);
  }
  for (int n = reduced; n < degree; ++n) {
    row[static_cast<std::size_t>(n + 1)] = row[static_cast<std::size_t>(n)];
    for (int i = n; i > 0; --i) {
      const double share = static_cast<double>(i) / (n + 1);
      row[static_cast<std::size_t>(i)] =
          share * row[static_cast<std::size_t>(i - 1)] + (1.0 - share) * row[static_cast<std::size_t>(i)];
    }
  }
}

/// De Casteljau's algorithm: `row` becomes its second half, the first one is returned.
PartRow split(PartRow& row, std::size_t degree) {
  PartRow left;
  for (std::size_t k = 0; k <= degree; ++k) {
    left[k] = row[0];
    for (std::size_t i = 0; i + k < degree; ++i) row[i] = 0.5 * (row[i] + row[i + 1]);
  }
  return left;
}

/// Stores ordinates as the signs are sought in them.
template <int Count>
class OrdinateWriter {
 public:
  explicit OrdinateWriter(SlopeOrdinates<Count>& ordinates) : ordinates_(ordinates) {}

  void append(const Parts& parts) {
    const auto i = static_cast<std::size_t>(count_++);
    ordinates_.x[i] = static_cast<float>(parts[0]);
    ordinates_.y[i] = static_cast<float>(parts[1]);
    ordinates_.constant[i] = static_cast<float>(parts[2]);
    largest_ = largest_.max(parts.abs());
  }

  /// Repeats the last one in the unused places, where it cannot show a change of sign.
  void finish() {
    const auto used = static_cast<std::size_t>(count_);
    for (auto* row : {&ordinates_.x, &ordinates_.y, &ordinates_.constant}) {
      std::fill(row->begin() + count_, row->end(), (*row)[used - 1]);
    }
    ordinates_.largest_x = static_cast<float>(largest_[0]);
    ordinates_.largest_y = static_cast<float>(largest_[1]);
    ordinates_.largest_constant = static_cast<float>(largest_[2]);
  }

 private:
  SlopeOrdinates<Count>& ordinates_;
  Parts largest_ = Parts::Zero();
  int count_ = 0;
};

void prepare_ordinates(CurveElement& curve, std::span<const Point> control_points) {
  const auto degree = static_cast<std::size_t>(2 * curve.degree - 1);
  PartRow row = bernstein_ordinates(curve);
  const auto other = [&](const Point& point) { return (point - control_points.front()).cwiseAbs().maxCoeff() > 0.0; };
  const auto different = [&](const Point& point) {
    return (point - control_points.back()).cwiseAbs().maxCoeff() > 0.0;
  };
  const auto equal_to_first =
      std::find_if(control_points.begin(), control_points.end(), other) - control_points.begin();
  const auto equal_to_last =
      std::find_if(control_points.rbegin(), control_points.rend(), different) - control_points.rbegin();
  divide_zeros_out(row, static_cast<int>(degree), static_cast<int>(equal_to_first) - 1,
                   static_cast<int>(equal_to_last) - 1);
  OrdinateWriter whole(curve.whole);
  for (std::size_t i = 0; i <= degree; ++i) whole.append(row[i]);
  whole.finish();

  curve.cells = curve.degree < 4 ? 8 : 4;
  std::array<PartRow, 8> cells;
  cells[0] = row;
  for (std::size_t width = static_cast<std::size_t>(curve.cells); width > 1; width /= 2) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(curve.cells); i += width) {
      PartRow right = cells[i];
      cells[i] = split(right, degree);
      cells[i + width / 2] = right;
    }
  }
  OrdinateWriter writer(curve.ordinates);
  writer.append(row[0]);
  for (int cell = 0; cell < curve.cells; ++cell) {
    for (std::size_t i = 1; i <= degree; ++i) writer.append(cells[static_cast<std::size_t>(cell)][i]);
  }
  writer.finish();
}

/// Gauss-Legendre quadrature of the speed with 2 nodes an interval.
void prepare_arc(CurveElement& curve) {
  constexpr double node = 0.57735026918962576;
  constexpr double half = 0.5 / CurveElement::arc_intervals;
  const auto speed = [&](double t) { return std::sqrt(curve.derivative(t).squaredNorm()); };
  for (int i = 0; i < CurveElement::arc_intervals; ++i) {
    const double middle = (2 * i + 1) * half;
    curve.arc[static_cast<std::size_t>(i + 1)] =
        curve.arc[static_cast<std::size_t>(i)] + half * (speed(middle - half * node) + speed(middle + half * node));
  }
}

}  // namespace

Point CurveElement::point(double t) const noexcept {
  Point sum = Point::Zero();
  for (int k = degree; k >= 1; --k) sum = (sum + coefficients[static_cast<std::size_t>(k - 1)]) * t;
  return origin + size * sum;
}

Point CurveElement::derivative(double t) const noexcept {
  Point sum = Point::Zero();
  for (int k = degree; k >= 1; --k) sum = sum * t + k * coefficients[static_cast<std::size_t>(k - 1)];
  return size * sum;
}

Point CurveElement::tangent(double t) const noexcept {
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

double CurveElement::arc_length(double t) const noexcept {
  const double scaled = std::clamp(t, 0.0, 1.0) * arc_intervals;
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

CurveElement prepare_curve(std::span<const Point> control_points) noexcept {
  CurveElement curve;
  curve.degree = static_cast<int>(control_points.size()) - 1;
  curve.origin = control_points[0];
  Point low = control_points[0], high = control_points[0];
  for (const Point& point : control_points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  curve.size = std::hypot(high.x() - low.x(), high.y() - low.y());
  curve.per_size = 1.0 / curve.size;

  const auto n = static_cast<std::size_t>(curve.degree);
  std::array<Point, max_curve_degree + 1> difference;
  for (std::size_t i = 0; i <= n; ++i) difference[i] = (control_points[i] - curve.origin) * curve.per_size;
  for (std::size_t k = 1; k <= n; ++k) {
    for (std::size_t i = 0; i + k <= n; ++i) difference[i] = difference[i + 1] - difference[i];
    curve.coefficients[k - 1] = binomial[n][k] * difference[0];
    curve.least_slope += 1e-5 * curve.coefficients[k - 1].squaredNorm();
  }
  prepare_ordinates(curve, control_points);
  prepare_arc(curve);
  return curve;
}

}  // namespace calligraphy
