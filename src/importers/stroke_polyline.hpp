// A stroke's centre line as a polyline; private to the model.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "polyline.hpp"

namespace calligraphy::recognition {

/// The stroke as a polyline nowhere farther than `tolerance` [em] from it, unless a curve is so large that it would
/// take more than 256 pieces.
Path flattened(std::string_view elements, std::span<const Point> control_points, double tolerance);

/// A chord of an element: its ends are fixed mixtures of the element's control points, `count` of them from `first` on.
struct StrokeChord {
  int first;
  int count;
  std::array<double, 4> from;
  std::array<double, 4> to;
};

/// The chords of a stroke with these elements, one to a line, `curve_steps` of equal parameter to a curve.
std::vector<StrokeChord> stroke_chords(std::string_view elements, int curve_steps);

}  // namespace calligraphy::recognition
