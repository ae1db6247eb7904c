// The rules that tell strokes of one element apart; private to the model. docs/strokes.md has them in words.
#pragma once

#include <array>
#include <span>

#include "brush.hpp"
#include "stroke_piece.hpp"

namespace calligraphy::recognition {

/// What the rules look at in a stroke without a corner. Directions in degrees, heng about 5, shu -90, pie -125, written
/// from -220 to 140 so that no stroke lies across the gap.
struct SimpleShape {
  double length = 0.0;           ///< of the path [em]
  double direction = 0.0;        ///< of the chord
  double leaving = 0.0;          ///< of the first third
  double arriving = 0.0;         ///< of the last third
  std::array<double, 5> fifths;  ///< of each fifth of the length
  double bulge = 0.0;            ///< mean offset from the chord over its length, left of travel positive [1]
  double line_error = 0.0;       ///< largest distance from the best line [em]
  double first = 0.0;            ///< of the first 0.04 em, brush entry included
  double last = 0.0;             ///< of the last 0.04 em, brush droop included
  bool entry = false;            ///< a brush was set down at the start
};

SimpleShape simple_shape(const Path& path, const Piece& whole, const CleanPath& clean);

/// Which stroke of one element the median of a brush stroke is.
int brush_stroke(const SimpleShape& shape);

/// Which stroke of one element a pen path is.
int pen_stroke(const SimpleShape& shape);

}  // namespace calligraphy::recognition
