// Certified distance between two polylines; private to the importers.
#pragma once

#include <span>

#include <calligraphy/model/point.hpp>

namespace calligraphy::recognition {

/// Hausdorff distance of two polylines [em], over all their points, not only the vertices. Accurate to `tolerance`,
/// except for paths so long that this would take too much time, where it may be larger; never too small by more than
/// rounding.
double hausdorff_distance(std::span<const Point> one, std::span<const Point> other, double tolerance);

}  // namespace calligraphy::recognition
