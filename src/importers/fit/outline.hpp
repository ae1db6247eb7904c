// The outline of a brush stroke, and the width of the brush from it; private to the importers.
#pragma once

#include <span>
#include <vector>

#include "polyline.hpp"

namespace calligraphy::recognition {

/// How far entries, droops and lifts of the brush take a path from the typical stroke that it follows [em], judging by
/// labels: a path farther off is of another kind.
inline constexpr double reach_of_brush = 0.043;

struct OutlineEdge {
  Point from, to;
  bool is_border = true;  ///< has ink on one side only; not so where two parts touch or overlap
};

/// One or several closed polygons. Ink is where their winding numbers do not add up to 0.
struct Outline {
  Outline() = default;  ///< of a pen, which has none
  Outline(std::span<const Point> polygon);
  Outline(const Path& polygon) : Outline(std::span(polygon)) {}
  /// The edges of several polygons are divided where they meet; parts less than 0.1 % of the em apart touch.
  /// O(vertices^2), but more than 500 vertices are taken as they are.
  explicit Outline(std::span<const Path> polygons);

  bool empty() const { return edges.empty(); }

  std::vector<OutlineEdge> edges;
  std::vector<Point> starts;  ///< the first vertex of each polygon
};

Eigen::AlignedBox2d box_of(const Outline& outline);

/// Radius of the largest disc about the point inside the outline [em]; 0 outside. O(edges).
double inscribed_radius(const Outline& outline, const Point& point);

/// Half the width of a brush stroke: the median of the inscribed radii at 19 places along its median, at most 15 % of
/// the median's length [em]. 0 without an outline.
double half_width(std::span<const Point> median, const Outline& outline);

/// How much of a median the tip of the brush covers at each end, which a path need not follow: up to where the
/// inscribed disc reaches the end of the median, at most a half-width [em]. A blunt end loses its half-width, a tapered
/// one nothing. 0 without an outline.
struct BrushEnds {
  double start = 0.0;
  double end = 0.0;
};
BrushEnds brush_ends(std::span<const Point> median, const Outline& outline, double half_width);

}  // namespace calligraphy::recognition
