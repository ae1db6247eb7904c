// The shape of ink, to be filled to draw a stroke as wide as the brush.
#pragma once

#include <span>
#include <vector>

#include <calligraphy/model/character.hpp>
#include <calligraphy/model/point.hpp>
#include <calligraphy/model/stroke_ink.hpp>

namespace calligraphy {

/// A disc of ink.
struct InkDisc {
  Point centre;   ///< on the centre line of the ink [em]
  double radius;  ///< half the width of the brush there [em]
};

/// The line along which a stroke's ink is laid: its path, extended straight at both ends, and the knots on it.
struct InkLine {
  std::vector<Point> points;         ///< on each knot, and evenly spaced between knots [em]
  std::vector<double> places;        ///< of each point among the knots: 2.25 is a quarter of the way from knot 2 to 3
  std::vector<double> knots;         ///< arc length of each knot [em]
  std::vector<Point> directions;     ///< at each knot, of the chord from 0.02 em before it to 0.02 em after it
  std::vector<std::size_t> corners;  ///< indices of the knots on corners
};

/// The line of a stroke with ink, with points at most `spacing` apart, but not many more than 2000. Three knots are at
/// the start, up to 0.035 and 0.08 em from it, where a brush is set down, and three at the end, from 0.1 and 0.045 em
/// on, or on a na from 0.15 and 0.075 em, where it is lifted; one is on each corner, and one 0.035 em before and after
/// it; the others are evenly in between. Short pieces between corners have their knots nearer to each other, and hooks
/// at even distances (docs/strokes.md).
/// @throws ValueError if it has no ink or the spacing is not positive
InkLine ink_line(const Stroke& stroke, double spacing = 0.004);

/// The ink of a stroke as discs about the points of its line, shifted and as wide as the profile says: both are linear
/// between knots. Where shifts take the discs apart, more discs fill the gap.
/// @throws ValueError if it has no ink or the spacing is not positive
std::vector<InkDisc> ink_discs(const Stroke& stroke, double spacing = 0.004);

/// Outline of the ink of a stroke: a closed polygon, counter-clockwise, whose last vertex is joined to the first,
/// within about `tolerance` of the discs' envelope [em]. Fill it by the nonzero rule, the default of SVG, Cairo, HTML
/// canvas and Matplotlib: where a stroke crosses itself or folds back, so does the outline.
/// @throws ValueError if it has no ink or the tolerance is not positive
std::vector<Point> ink_outline(const Stroke& stroke, double tolerance = 5e-4);

/// The same of any discs in order. @throws ValueError if there are none or the tolerance is not positive
std::vector<Point> ink_outline(std::span<const InkDisc> discs, double tolerance = 5e-4);

}  // namespace calligraphy
