// Lengths and products of vectors, the same to the last bit everywhere: Eigen adds three products in an order that
// depends on the width of the processor's registers.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// sqrt(x^2 + y^2) without intermediate overflow or underflow. std::hypot rounds as its libm does; a square root is
/// correctly rounded everywhere. Infinite or NaN where a coordinate is.
inline double length(const Point& vector) noexcept {
  const double square = vector.squaredNorm();
  if (square > 0x1p-900 && square < std::numeric_limits<double>::infinity()) return std::sqrt(square);
  const double scale = vector.cwiseAbs().maxCoeff() < 1.0 ? 0x1p600 : 0x1p-600;
  return (scale * vector).norm() / scale;
}

inline double dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) noexcept {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

/// Without a loop over the coordinates, as allFinite() is: zero times infinity or NaN is NaN.
inline bool is_finite(const Eigen::Vector3d& vector) noexcept {
  return dot(Eigen::Vector3d(0.0, 0.0, 0.0), vector) == 0.0;
}

/// Norm of a force or displacement in space, whose squares are finite.
inline double norm(const Eigen::Vector3d& vector) noexcept { return std::sqrt(dot(vector, vector)); }

/// `vector`, or the one of length `longest` >= 0 in its direction.
inline Eigen::Vector3d shortened(const Eigen::Vector3d& vector, double longest) noexcept {
  const double square = dot(vector, vector);  // most need no root
  return square > longest * longest ? Eigen::Vector3d(vector * (longest / std::sqrt(square))) : vector;
}

}  // namespace calligraphy
