// Recognition of a pen path as a typical stroke, and fitting of its control points.
#pragma once

#include <span>

#include <calligraphy/model/character.hpp>
#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// What the path was drawn with, and therefore which parts of it a pen would not write.
enum class DrawingTool {
  brush,         ///< the median of a brush stroke: entry, droop and shoulders are removed
  textbook_pen,  ///< a line in textbook style: its pressed start is removed
  pen            ///< a plain line: nothing is removed
};

struct StrokeFitOptions {
  DrawingTool drawing_tool = DrawingTool::brush;
  std::span<const int> ids = {};  ///< candidate typical strokes, from a label; empty: all, by geometry alone
};

/// A stroke recognised and fitted.
struct FittedStroke {
  StrokeInput stroke;
  double error;         ///< maximum distance between path and stroke, in both directions, to 1e-4 em [em]
  double median_error;  ///< the same for the path with its shoulders, the corners that a brush's median cuts [em]
};

/// Finds the typical stroke and its control points for a pen path, a polyline in em, y up. Removed parts of a path do
/// not count in the errors; docs/strokes.md describes them. A path that no stroke of `ids` can follow (a dot, or a path
/// with fewer corners than they have) becomes a straight dian (8).
/// @throws ValueError if there are no points, a point is not finite or farther than 15 em, or an id is not in 1..39
FittedStroke fit_stroke(std::span<const Point> path, const StrokeFitOptions& options = {});

}  // namespace calligraphy
