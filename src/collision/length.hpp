// The length of a vector, to the same bit everywhere.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// sqrt(x^2 + y^2) without overflow or underflow in between. std::hypot rounds as its libm does; a root is rounded
/// correctly everywhere. Infinite or NaN where a coordinate is.
inline double length(const Point& vector) noexcept {
  const double square = vector.squaredNorm();
  if (square > 0x1p-900 && square < std::numeric_limits<double>::infinity()) return std::sqrt(square);
  const double scale = vector.cwiseAbs().maxCoeff() < 1.0 ? 0x1p600 : 0x1p-600;
  return (scale * vector).norm() / scale;
}

}  // namespace calligraphy
