// The width of a brush stroke, from its outline; private to the importers.
#pragma once

#include <span>

#include "polyline.hpp"

namespace calligraphy::recognition {

/// How far entries, droops and lifts of the brush take a path from the typical stroke that it follows [em], judging by
/// labels: a path farther off is of another kind.
inline constexpr double reach_of_brush = 0.043;

/// Radius of the largest disc about the point inside the outline, a closed polygon [em]; 0 outside. O(vertices).
double inscribed_radius(std::span<const Point> outline, const Point& point);

/// Half the width of a brush stroke: the median of the inscribed radii at 19 places along its median, at most 15 % of
/// the median's length [em]. 0 without an outline.
double half_width(std::span<const Point> median, std::span<const Point> outline);

/// How much of a median the tip of the brush covers at each end, which a path need not follow: up to where the
/// inscribed disc reaches the end of the median, at most a half-width [em]. A blunt end loses its half-width, a tapered
/// one nothing. 0 without an outline.
struct BrushEnds {
  double start = 0.0;
  double end = 0.0;
};
BrushEnds brush_ends(std::span<const Point> median, std::span<const Point> outline, double half_width);

}  // namespace calligraphy::recognition
