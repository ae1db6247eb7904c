// A test for NaN and infinities, without a loop over the coordinates.
#pragma once

#include <Eigen/Core>

namespace calligraphy {

/// Zero times infinity or NaN is NaN.
inline bool is_finite(const Eigen::Vector3d& vector) noexcept {
  return 0.0 * vector.x() + 0.0 * vector.y() + 0.0 * vector.z() == 0.0;
}

}  // namespace calligraphy
