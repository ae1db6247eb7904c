// Lines without the points that nobody can see.
#pragma once

#include <vector>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// Ramer, Douglas and Peucker: no point of the path, which has at least one, is further than `tolerance` from what is
/// left of it.
std::vector<Point> thinned(const std::vector<Point>& path, double tolerance);

}  // namespace calligraphy
