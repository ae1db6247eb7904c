// Ranges of directions and numbers for the stroke rules; private to the importers.
#pragma once

#include <algorithm>
#include <cmath>

#include "polyline.hpp"

namespace calligraphy::recognition {

/// A closed interval; a range of directions may extend past 180 degrees.
struct Range {
  double from;
  double to;
};

inline bool contains(const Range& range, double degrees) {
  return std::abs(wrapped(degrees - 0.5 * (range.from + range.to))) <= 0.5 * (range.to - range.from);
}

/// Distance of a direction from the range [degree]; 0 inside.
inline double outside(const Range& range, double degrees) {
  const double half = 0.5 * (range.to - range.from);
  return std::max(0.0, std::abs(wrapped(degrees - 0.5 * (range.from + range.to))) - half);
}

/// Distance of a number from the range; 0 inside.
inline double beyond(const Range& range, double value) { return std::max({0.0, range.from - value, value - range.to}); }

}  // namespace calligraphy::recognition
