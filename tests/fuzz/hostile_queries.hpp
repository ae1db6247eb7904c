// Queries at which the nearest point of a curve is hard to tell: ties, centres of curvature, end normals, far away.
#pragma once

#include <span>

#include "hostile_curves.hpp"

namespace calligraphy_test {

/// A query to a curve, of a kind drawn at random. The curve is not yet at its place.
Point draw_query(RandomPoints& random, std::span<const Point> control_points);

/// A query whose nearest points on two branches are equally far to the last bits: between two random queries whose feet
/// are far apart, by halving. What is under test only steers it.
Point draw_tie(RandomPoints& random, std::span<const Point> control_points);

}  // namespace calligraphy_test
