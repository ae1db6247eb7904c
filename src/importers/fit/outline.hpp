// The width of a brush stroke, from its outline; private to the importers.
#pragma once

#include <span>

#include "polyline.hpp"

namespace calligraphy::recognition {

/// How far from the typical stroke entries, droops and lifts of the brush take a path that follows it [em], as labels
/// show: what is farther off is of another kind.
inline constexpr double reach_of_brush = 0.043;

/// Radius of the largest disc about the point inside the outline, a closed polygon [em]; 0 outside. O(vertices).
double inscribed_radius(std::span<const Point> outline, const Point& point);

/// Half the width of a brush stroke: the median of the inscribed radii at 19 places along its median, at most 15 % of
/// the median's length [em]. 0 without an outline.
double half_width(std::span<const Point> median, std::span<const Point> outline);

/// What the brush itself writes at each end of a median, which a path need not follow: as far as the disc there reaches
/// the end of the median, at most a half-width [em]. A blunt end loses its half-width, one that tapers to a point
/// nothing. 0 without an outline.
struct BrushEnds {
  double start = 0.0;
  double end = 0.0;
};
BrushEnds brush_ends(std::span<const Point> median, std::span<const Point> outline, double half_width);

}  // namespace calligraphy::recognition
