// Recognition of a pen path as a typical stroke, and fitting of its control points.
#pragma once

#include <span>

#include <calligraphy/model/character.hpp>
#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// What is known about a path besides its points.
struct StrokeFitOptions {
  std::span<const Point> outline = {};  ///< polygon around the brush stroke whose median is the path; empty: a pen
  std::span<const int> ids = {};        ///< candidate typical strokes, from a label; empty: all, by geometry alone
};

/// A recognised and fitted stroke.
struct FittedStroke {
  StrokeInput stroke;         ///< its typical stroke, control points and elements
  double error = 0.0;         ///< discrete Fréchet distance of stroke and path, which respects order; the stroke may
                              ///< begin and end within `half_width` of the path's ends [em]
  double unbent_error = 0.0;  ///< the same before any line of the typical stroke became a curve [em]
  double half_width = 0.0;  ///< of the brush: median of the radii that fit into the outline along the path, at most 15
                            ///< % of its length; 0 without an outline [em]
  int recognised = 0;       ///< the typical stroke by geometry alone
};

/// Finds the typical stroke and its control points for a path, a polyline in em, y up. The stroke follows the
/// whole path in order, from the first point to the last; only a median is shortened, at each end by as much as the tip
/// of the brush covers (docs/strokes.md). A path that no stroke of `ids` can follow, such as a dot, becomes a straight
/// dian (8).
/// @throws ValueError if there are no points, a point of path or outline is not finite or farther than 15 em from the
///         origin, or an id is not in 1..39
FittedStroke fit_stroke(std::span<const Point> path, const StrokeFitOptions& options = {});

}  // namespace calligraphy
