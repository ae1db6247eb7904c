// A stroke element prepared for queries (Wang 2006, sec. 3.3: LSE and CSE).
#pragma once

#include <algorithm>
#include <span>
#include <variant>
#include <vector>

#include <calligraphy/collision/detail/curve_element.hpp>
#include <calligraphy/collision/detail/line_element.hpp>
#include <calligraphy/model/placed_character.hpp>

namespace calligraphy {

/// A line or a curve, with their common interface.
struct StrokeElement {
  /// Prepared for queries; the functions below serve either.
  std::variant<detail::LineElement, detail::CurveElement> kind;

  /// The line, or null if it is a curve.
  const detail::LineElement* line() const noexcept { return std::get_if<detail::LineElement>(&kind); }
  /// The curve, or null if it is a line.
  const detail::CurveElement* curve() const noexcept { return std::get_if<detail::CurveElement>(&kind); }

  /// 1 for a line or a point, 2 to 4 for a curve.
  int degree() const noexcept { return curve() ? curve()->degree : 1; }
  /// First control point.
  const Point& origin() const noexcept { return curve() ? curve()->origin : line()->origin; }
  /// Diagonal of the bounding box of the control points [m]; 0 for a point.
  double size() const noexcept { return curve() ? curve()->size : line()->length; }
  /// Arc length, as accurate as arc_length() [m].
  double length() const noexcept { return curve() ? curve()->arc.back() : line()->length; }
  /// Point at a parameter in [0, 1] [m].
  Point point(double t) const noexcept { return curve() ? curve()->point(t) : line()->point(t); }
  /// First derivative with respect to the parameter, dB/dt [m].
  Point derivative(double t) const noexcept { return curve() ? curve()->derivative(t) : line()->edge; }
  /// Unit tangent in writing direction, also where dB/dt vanishes; zero for a point.
  Point tangent(double t) const noexcept { return curve() ? curve()->tangent(t) : line()->direction; }
  /// Curvature, positive where the element bends to the left; grows without bound towards a cusp, and is 0 where dB/dt
  /// vanishes and on a line [1/m].
  double curvature(double t) const noexcept { return curve() ? curve()->curvature(t) : 0.0; }
  /// Arc length from 0 to t, which is clamped to [0, 1] (NaN counts as 0); exact on a line, accurate to 3e-3 of the
  /// size on a curve (1e-4 on typical strokes) [m].
  double arc_length(double t) const noexcept {
    if (curve()) return curve()->arc_length(t);
    return t > 0.0 ? std::min(t, 1.0) * length() : 0.0;
  }
  /// Parameter at an arc length, clamped to [0, 1]; the inverse of arc_length.
  double parameter_at(double arc_length) const noexcept {
    if (!(arc_length > 0.0)) return 0.0;
    if (!(arc_length < length())) return 1.0;
    return curve() ? curve()->parameter_at(arc_length) : arc_length / length();
  }
};

/// Prepares 2 to 5 control points: an element of a degree one lower, or a point when all are equal (within 1e-300 m).
/// If one is not finite or farther than 1e150 m from the first, or for any other number of points, the length is NaN
/// and every query returns the status not_finite. Does not allocate.
StrokeElement prepare_element(std::span<const Point> control_points) noexcept;

/// The elements of a stroke as placed, in writing order, prepared for queries [m].
std::vector<StrokeElement> place_elements(const Stroke& stroke, const Placement& placement);

/// The elements of each stroke of a character, in writing order [m].
std::vector<std::vector<StrokeElement>> place_elements(const PlacedCharacter& placed);

}  // namespace calligraphy
