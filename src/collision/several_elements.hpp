// What searches over several elements share.
#pragma once

#include <limits>

#include <calligraphy/collision/nearest_point.hpp>

namespace calligraphy {

/// Rounding error of a distance, relative to it and to the size of the element.
inline constexpr double distance_rounding = 1e-14;

/// Distances to elements of at most this size that differ by no more count as equal.
inline double distance_tie(double size, double distance) noexcept {
  return distance_rounding * size + 2.0 * std::numeric_limits<double>::epsilon() * distance;
}

/// Squares of smaller lengths are inexact.
inline constexpr double min_square_root = 1e-150;

/// The answer of no elements.
inline NearestPoint no_point() noexcept {
  NearestPoint nowhere;
  nowhere.distance = std::numeric_limits<double>::infinity();
  nowhere.status = NearestPointStatus::not_finite;
  return nowhere;
}

}  // namespace calligraphy
