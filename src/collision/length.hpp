// Lengths and products of vectors that are the same to the last bit everywhere: the order in which Eigen adds three
// products depends on the width of the processor's registers.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// sqrt(x^2 + y^2) without intermediate overflow or underflow. std::hypot rounds as its libm does; a square root is
/// correctly rounded everywhere. Infinite or NaN if a coordinate is.
inline double length(const Point& vector) noexcept {
  const double square = vector.squaredNorm();
  if (square > 0x1p-900 && square < std::numeric_limits<double>::infinity()) [[likely]] return std::sqrt(square);
  const double scale = vector.cwiseAbs().maxCoeff() < 1.0 ? 0x1p600 : 0x1p-600;
  return (scale * vector).norm() / scale;
}

inline double dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) noexcept {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

/// Avoids the loop of allFinite(): zero times infinity or NaN is NaN.
inline bool is_finite(const Eigen::Vector3d& vector) noexcept {
  return dot(Eigen::Vector3d(0.0, 0.0, 0.0), vector) == 0.0;
}

/// Norm of a force or displacement, whose squares are finite.
inline double norm(const Eigen::Vector3d& vector) noexcept { return std::sqrt(dot(vector, vector)); }

/// The vector, shortened to length `longest` >= 0 if it is longer.
inline Eigen::Vector3d shortened(const Eigen::Vector3d& vector, double longest) noexcept {
  const double square = dot(vector, vector);  // usually no root is needed
  return square > longest * longest ? Eigen::Vector3d(vector * (longest / std::sqrt(square))) : vector;
}

}  // namespace calligraphy
