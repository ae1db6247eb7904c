// Where the subdivision as printed stopped (Wang 2006, sec. 4.3.2).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <calligraphy/collision/nearest_point.hpp>

namespace calligraphy_test {

using calligraphy::ParameterRange;
using calligraphy::Point;

/// The last interval of a bisection of [0, 1] that ended with this midpoint: k / 2^n with odd k is the midpoint of an
/// interval of length 2^(1 - n).
inline ParameterRange last_interval(double middle) {
  double half = 0.5;
  while (half > 1e-300 && std::fmod(middle, 2.0 * half) != half) half *= 0.5;
  return {middle - half, middle + half};
}

/// Epsilon in metres: the tolerance, but not finer than the coordinates.
inline double wang2006_epsilon(const calligraphy::StrokeElement& element, const Point& query, double tolerance) {
  const double coordinates =
      std::max({element.origin().cwiseAbs().maxCoeff(), element.size(), query.cwiseAbs().maxCoeff()});
  return std::max(tolerance * element.size(), 4.0 * std::numeric_limits<double>::epsilon() * coordinates);
}

}  // namespace calligraphy_test
