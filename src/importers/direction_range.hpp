// Ranges of directions and of numbers, as the rules about strokes state them; private to the model.
#pragma once

#include <algorithm>
#include <cmath>

#include "polyline.hpp"

namespace calligraphy::recognition {

/// From and to, the ends included; a range of directions may go past 180 degrees.
struct Range {
  double from;
  double to;
};

inline bool contains(const Range& range, double degrees) {
  return std::abs(wrapped(degrees - 0.5 * (range.from + range.to))) <= 0.5 * (range.to - range.from);
}

/// How far outside the range a direction is [degree].
inline double outside(const Range& range, double degrees) {
  const double half = 0.5 * (range.to - range.from);
  return std::max(0.0, std::abs(wrapped(degrees - 0.5 * (range.from + range.to))) - half);
}

/// How far outside the range a number is.
inline double beyond(const Range& range, double value) { return std::max({0.0, range.from - value, value - range.to}); }

}  // namespace calligraphy::recognition
