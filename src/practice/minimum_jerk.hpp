// Share of its way that a hand has covered after a share of the time, with minimum jerk (Flash and Hogan 1985).
#pragma once

#include <algorithm>

namespace calligraphy {

inline double minimum_jerk(double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  return t * t * t * (10.0 + t * (-15.0 + 6.0 * t));
}

}  // namespace calligraphy
