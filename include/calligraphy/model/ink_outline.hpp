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

/// Ink along a path, a polyline [em], as discs evenly spaced along the extended path: at most `spacing` apart, but no
/// more than 2000. Sideways means perpendicular to the chord from 0.02 em before a point to 0.02 em after it, so
/// corners are rounded. Centres and radii are linear in the offsets and half-widths of the profile.
/// @throws ValueError if the path has no point or the spacing is not positive
std::vector<InkDisc> ink_discs(std::span<const Point> path, const StrokeInk& ink, double spacing = 0.004);

/// Outline of the ink along a path: a closed polygon, counter-clockwise, whose last vertex is joined to the first,
/// within about `tolerance` of the discs' envelope [em]. Fill it by the nonzero rule, the default of SVG, Cairo, HTML
/// canvas and Matplotlib: where a stroke crosses itself or folds back, so does the outline.
/// @throws ValueError if the path has no point or the tolerance is not positive
std::vector<Point> ink_outline(std::span<const Point> path, const StrokeInk& ink, double tolerance = 5e-4);

/// The same of any discs in order. @throws ValueError if there are none or the tolerance is not positive
std::vector<Point> ink_outline(std::span<const InkDisc> discs, double tolerance = 5e-4);

/// The same along the path of a stroke. @throws ValueError if it has no ink or the tolerance is not positive
std::vector<Point> ink_outline(const Stroke& stroke, double tolerance = 5e-4);

}  // namespace calligraphy
