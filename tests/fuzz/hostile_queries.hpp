// Queries for which the nearest point of a curve is hard to determine: ties, centres of curvature, end normals, far
// away.
#pragma once

#include <span>

#include "hostile_curves.hpp"

namespace calligraphy_test {

/// A query to a curve, of a random kind. The curve is not yet transformed.
Point draw_query(RandomPoints& random, std::span<const Point> control_points);

/// A query whose nearest points on two branches are equally far to the last bits: by bisection between two random
/// queries whose closest points are far apart. The code under test only steers the search.
Point draw_tie(RandomPoints& random, std::span<const Point> control_points);

}  // namespace calligraphy_test
