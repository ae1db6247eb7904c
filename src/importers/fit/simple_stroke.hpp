// The rules that distinguish strokes of one element (docs/strokes.md); private to the importers.
#pragma once

#include <array>
#include <span>

#include "brush.hpp"
#include "stroke_piece.hpp"

namespace calligraphy::recognition {

/// Features of a stroke without a corner. Directions in degrees, heng about 5, shu -90, pie -125, in the range -220 to
/// 140, so that no stroke lies across the discontinuity.
struct SimpleShape {
  double length = 0.0;           ///< of the path [em]
  double direction = 0.0;        ///< of the chord
  double leaving = 0.0;          ///< of the first third
  double arriving = 0.0;         ///< of the last third
  std::array<double, 5> fifths;  ///< of each fifth of the length
  double bulge = 0.0;            ///< mean offset from the chord, divided by its length, left of travel positive [1]
  double line_error = 0.0;       ///< maximum distance from the best line [em]
  double first = 0.0;            ///< of the first 0.04 em, brush entry included
  double last = 0.0;             ///< of the last 0.04 em, brush droop included
  bool entry = false;            ///< a brush was set down at the start
};

SimpleShape simple_shape(const Path& path, const Piece& whole, const CleanPath& clean);

/// Id of the one-element stroke that the median of a brush stroke is.
int brush_stroke(const SimpleShape& shape);

/// Id of the one-element stroke that a pen path is.
int pen_stroke(const SimpleShape& shape);

}  // namespace calligraphy::recognition
