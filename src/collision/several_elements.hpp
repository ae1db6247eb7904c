// What searches over several elements share.
#pragma once

#include <limits>

#include <calligraphy/collision/nearest_point.hpp>

namespace calligraphy {

/// Rounding error of a distance, relative to it and to the size of the element.
inline constexpr double distance_rounding = 1e-14;

/// Distances that differ by no more than this from a distance to the element count as equal to it.
inline double distance_tie(const StrokeElement& element, double distance) noexcept {
  return distance_rounding * element.size() + 2.0 * std::numeric_limits<double>::epsilon() * distance;
}

/// The answer of no elements.
inline NearestPoint no_point() noexcept {
  NearestPoint nowhere;
  nowhere.distance = std::numeric_limits<double>::infinity();
  nowhere.status = NearestPointStatus::not_finite;
  return nowhere;
}

}  // namespace calligraphy
