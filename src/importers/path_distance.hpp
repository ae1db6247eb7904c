// How far two polylines are apart, certified; private to the model.
#pragma once

#include <span>

#include <calligraphy/model/point.hpp>

namespace calligraphy::recognition {

/// Hausdorff distance of two polylines [em]: the larger of the farthest point of one from the other, and back. Every
/// point of them counts, not their vertices alone. Right to within `tolerance`, or too large by more where the paths
/// are so long that it would take too much time; never too small by more than rounding.
double hausdorff_distance(std::span<const Point> one, std::span<const Point> other, double tolerance);

}  // namespace calligraphy::recognition
