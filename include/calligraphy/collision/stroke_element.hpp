// A stroke element prepared for queries (Wang 2006, sec. 3.3: LSE and CSE).
#pragma once

#include <array>
#include <span>

#include <calligraphy/model/point.hpp>
#include <calligraphy/model/typical_stroke.hpp>

namespace calligraphy {

/// A line segment (degree 1, which may be a point) or a Bezier curve (degree 2 to 4), ready for the servo loop.
///
/// Coefficients are relative to the first control point and to the size, so that a curve far from the origin, very
/// small or very large is answered as well as one in the unit square:
/// B(t) = origin + size * (c_1 t + c_2 t^2 + ... + c_n t^n).
struct StrokeElement {
  static constexpr int arc_intervals = 32;

  int degree = 1;
  Point origin = Point::Zero();                                   ///< first control point
  double size = 0.0;                                              ///< diagonal of the control points' box
  std::array<Point, max_curve_degree> coefficients = {};          ///< c_1 to c_n, relative to size
  std::array<double, 2 * max_curve_degree> slope_of_square = {};  ///< power coefficients of (B - origin).B' / size^2
  std::array<double, arc_intervals + 1> arc = {};                 ///< arc length from 0 to i / 32 [m]

  double length() const noexcept { return arc.back(); }
  Point point(double t) const noexcept;
  /// dB/dt
  Point derivative(double t) const noexcept;
  /// Unit tangent in writing direction, also where dB/dt vanishes; zero for a point.
  Point tangent(double t) const noexcept;
  /// Arc length from 0 to t, to 3e-3 of the size (1e-4 on typical strokes); exact on a line.
  double arc_length(double t) const noexcept;
  /// Parameter at an arc length, clamped to [0, 1]; the inverse of arc_length.
  double parameter_at(double arc_length) const noexcept;
};

/// Prepares 2 to 5 control points, an element of degree one less. No allocation; about 0.4 us for a cubic.
StrokeElement prepare_element(std::span<const Point> control_points) noexcept;

}  // namespace calligraphy
