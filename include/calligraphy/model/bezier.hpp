// Bezier curve of any degree (Wang 2006, sec. 3.3, eq. (1)).
#pragma once

#include <array>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// Bezier curve of the given degree with Degree + 1 control points.
///
/// Wang 2006, eq. (1) calls itself "third order" but sums to 4 with 4!, a quartic: that curve is Bezier<4>.
/// The counts in Table 3 require cubics, so the stroke model uses Bezier<3> by default.
template <int Degree>
struct Bezier {
  static_assert(Degree >= 1);

  std::array<Point, Degree + 1> control_points;  ///< the first and the last are the ends of the curve

  /// Point at parameter t in [0, 1], by de Casteljau's algorithm.
  Point point(double t) const {
    auto row = control_points;
    for (int count = Degree; count > 0; --count) {
      for (int i = 0; i < count; ++i) row[i] += t * (row[i + 1] - row[i]);
    }
    return row[0];
  }

  /// Control points of the first derivative, a curve one degree lower.
  Bezier<Degree - 1> hodograph() const requires(Degree >= 2) {
    Bezier<Degree - 1> result;
    for (int i = 0; i < Degree; ++i) result.control_points[i] = Degree * (control_points[i + 1] - control_points[i]);
    return result;
  }

  /// First derivative with respect to t.
  Point derivative(double t) const {
    if constexpr (Degree == 1) {
      return control_points[1] - control_points[0];
    } else {
      return hodograph().point(t);
    }
  }

  /// Splits the curve at t into two curves, over [0, t] and [t, 1].
  std::array<Bezier, 2> split(double t) const {
    std::array<Bezier, 2> halves;
    auto row = control_points;
    for (int count = Degree; count >= 0; --count) {
      halves[0].control_points[Degree - count] = row[0];
      halves[1].control_points[count] = row[count];
      for (int i = 0; i < count; ++i) row[i] += t * (row[i + 1] - row[i]);
    }
    return halves;
  }

  /// The same curve one degree higher (exact degree elevation).
  Bezier<Degree + 1> elevated() const {
    Bezier<Degree + 1> result;
    result.control_points.front() = control_points.front();
    result.control_points.back() = control_points.back();
    for (int i = 1; i <= Degree; ++i) {
      const double share = static_cast<double>(i) / (Degree + 1);
      result.control_points[i] = share * control_points[i - 1] + (1.0 - share) * control_points[i];
    }
    return result;
  }
};

}  // namespace calligraphy
