// A stroke's centre line as a polyline; private to the importers.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "polyline.hpp"

namespace calligraphy::recognition {

/// The stroke as a polyline within `tolerance` [em] of it, unless a curve is so large that this would require more than
/// 256 pieces.
Path flattened(std::string_view elements, std::span<const Point> control_points, double tolerance);

/// A chord of an element: its ends are fixed linear combinations of `count` control points from index `first`.
struct StrokeChord {
  int first;
  int count;
  std::array<double, 4> from;
  std::array<double, 4> to;
};

/// The chords of a stroke with these elements: one per line, `curve_steps` of equal parameter length per curve.
std::vector<StrokeChord> stroke_chords(std::string_view elements, int curve_steps);

}  // namespace calligraphy::recognition
