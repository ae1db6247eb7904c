// From a pen path to the typical stroke that it is, and the control points that follow it.
#pragma once

#include <span>

#include <calligraphy/model/character.hpp>
#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// What the path was drawn with, and so what of it a pen does not write.
enum class DrawnWith {
  brush,         ///< the median of a brush stroke: entry, droop and shoulders are removed
  textbook_pen,  ///< a line in a textbook hand: its pressed start is removed
  pen            ///< a line as it is
};

struct StrokeFitOptions {
  DrawnWith drawn_with = DrawnWith::brush;
  std::span<const int> ids = {};  ///< typical strokes that it may be, as a label says; none: all, by geometry alone
};

/// A stroke recognised and fitted.
struct FittedStroke {
  StrokeInput stroke;
  double error;         ///< largest distance between path and stroke, both ways, to 1e-4 em [em]
  double median_error;  ///< the same where the path keeps its shoulders: the corners that a brush's median cuts [em]
};

/// Finds the typical stroke and its control points for a pen path, a polyline in em, y up. What is removed of a path is
/// not part of the errors; docs/strokes.md says what that is and how much. What no stroke of `ids` can follow, a dot or
/// a path with fewer corners than they have, becomes a straight dian (8).
/// @throws ValueError when there is no point, a point is not finite or farther than 15 em, or an id is not in 1..39
FittedStroke fit_stroke(std::span<const Point> path, const StrokeFitOptions& options = {});

}  // namespace calligraphy
