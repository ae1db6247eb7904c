// The shape of ink: what to fill to draw a stroke with the width of the brush.
#pragma once

#include <vector>

#include <calligraphy/model/character.hpp>
#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// A disc of ink.
struct InkDisc {
  Point centre;   ///< [em]
  double radius;  ///< [em]
};

/// The ink of a stroke as discs equally far along its drawn out path, at most `spacing` apart but no more than 2000.
/// Sideways is at right angles to the chord of 0.02 em before and after a point, so that corners are rounded. Centres
/// and radii are linear in the offsets and half-widths of the profile.
/// @throws ValueError if the stroke has no ink or the spacing is not positive
std::vector<InkDisc> ink_discs(const Stroke& stroke, double spacing = 0.004);

/// Outline of the ink: a closed polygon, counter-clockwise, whose last vertex is joined to the first, within about
/// `tolerance` of the discs' envelope [em]. To be filled by the nonzero rule, the default of SVG, Cairo, the canvas of a
/// web page and Matplotlib: where a stroke crosses itself, so does the outline.
/// @throws ValueError if the stroke has no ink or the tolerance is not positive
std::vector<Point> ink_outline(const Stroke& stroke, double tolerance = 5e-4);

}  // namespace calligraphy
