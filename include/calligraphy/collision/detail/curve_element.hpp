// A Bezier curve of a stroke, prepared for queries: the CSE of the paper (Wang 2006, sec. 3.3, eq. (1)).
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <calligraphy/model/point.hpp>
#include <calligraphy/model/typical_stroke.hpp>

namespace calligraphy::detail {

/// Bernstein ordinates of g(t) = (B(t) - q) . B'(t), half the slope of the squared distance to a query q. They are
/// affine in q: g_i = x_i q_x + y_i q_y + constant_i, with q relative to the curve's origin and size. Their signs bound
/// the number of nearest points and locate them. In single precision: signs that rounding could flip are not used.
/// Stored in the order in which SIMD registers load them.
template <std::size_t Count>
struct SlopeOrdinates {
  alignas(16) std::array<float, Count> x = {}, y = {}, constant = {};
  /// The error of an ordinate is at most |q_x| noise_x + |q_y| noise_y + noise_constant.
  float noise_x = 0.0F, noise_y = 0.0F, noise_constant = 0.0F;
};

/// A curve of degree 2 to 4.
///
/// Coefficients are relative to the first control point and to the size, so that a curve far from the origin, very
/// small or very large is as accurate as one in the unit square:
/// B(t) = origin + size * (c_1 t + c_2 t^2 + ... + c_n t^n).
struct CurveElement {
  static constexpr int arc_intervals = 32;
  static constexpr std::size_t whole_ordinates = 2 * max_curve_degree;
  static constexpr std::size_t max_ordinates = 48;

  int degree = 2;
  int cells = 8;                 ///< number of equal parts of [0, 1], each with its own `ordinates`
  double size = 0.0;             ///< diagonal of the bounding box of the control points [m]
  double per_size = 0.0;         ///< 1 / size
  double min_slope = 0.0;        ///< slope of g below which Newton's method is not trusted
  Point origin = Point::Zero();  ///< first control point
  std::array<Point, max_curve_degree> coefficients = {};          ///< c_1 to c_n
  std::array<double, 2 * max_curve_degree> slope_of_square = {};  ///< of (B - origin) . B', by powers of t
  SlopeOrdinates<whole_ordinates> whole;                          ///< of the whole curve
  SlopeOrdinates<max_ordinates> ordinates;                        ///< of the cells; adjacent ones share an ordinate
  std::array<double, arc_intervals + 1> arc = {};                 ///< arc length from 0 to i / 32 [m]

  Point point(double t) const noexcept;
  /// dB/dt
  Point derivative(double t) const noexcept { return size * derivative_per_size(t); }
  /// dB/dt divided by the size [1]
  Point derivative_per_size(double t) const noexcept;
  /// Unit tangent in writing direction, even where dB/dt vanishes.
  Point tangent(double t) const noexcept;
  /// Positive where the curve bends to the left; 0 where dB/dt vanishes [1/m].
  double curvature(double t) const noexcept;
  /// Arc length from 0 to t, accurate to 3e-3 of the size (1e-4 on typical strokes); t is clamped to [0, 1]; NaN counts
  /// as 0 [m].
  double arc_length(double t) const noexcept;
  /// Parameter at an arc length in (0, length); the inverse of arc_length.
  double parameter_at(double arc_length) const noexcept;
};

/// Prepares 3 to 5 control points, finite and not all equal as checked by prepare_element. Does not allocate.
CurveElement prepare_curve(std::span<const Point> control_points) noexcept;

}  // namespace calligraphy::detail
