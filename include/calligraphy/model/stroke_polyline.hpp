// A stroke's path as a polyline.
#pragma once

#include <vector>

#include <calligraphy/model/character.hpp>
#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// The path of a stroke as a polyline with its vertices on the path, within `tolerance` of it [em] unless a curve is so
/// large that this would take more than 256 pieces.
std::vector<Point> stroke_polyline(const Stroke& stroke, double tolerance = 1e-4);

}  // namespace calligraphy
