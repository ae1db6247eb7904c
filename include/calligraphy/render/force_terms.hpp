// The force terms as pure functions (Wang 2006, sec. 5, eq. (7)-(9); sec. 2.2, Fig. 4).
#pragma once

#include <algorithm>
#include <cmath>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// In-plane attraction, eq. (8): K (X_s - X_p), where K includes the attraction factor and the guidance weight [N]. As
/// printed: K (X_p - X_s).
inline Point attraction_force(double stiffness, const Point& tip, const Point& closest) noexcept {
  return stiffness * (closest - tip);
}

/// Saturates a linear force at `limit` [N]: F / sqrt(1 + (F / limit)^2). Near the stroke the stiffness is that of eq.
/// (8); beyond a distance of limit / K the force hardly increases, so a device can render it at any distance.
inline Point saturated_force(const Point& force, double limit) noexcept {
  const double share = force.norm() / limit;
  return force / std::sqrt(1.0 + share * share);
}

/// Normal force, eq. (9): K d along the normal out of the paper, d = max(0, penetration) [N]. As printed: K (z_p - z_0)
/// for z_p >= z_0 along the axis of z_p itself, which pulls the pen further in.
inline double normal_force(double stiffness, double penetration) noexcept {
  return stiffness * std::max(0.0, penetration);
}

/// Resistance to writing backwards (Fig. 4): a spring along the tangent in writing direction, from the furthest point
/// reached, with a dead band of `slack` [m] and a maximum force of `limit` [N].
inline Point wrong_way_force(double stiffness, double limit, double slack, double backwards,
                             const Point& tangent) noexcept {
  return std::min(stiffness * std::max(0.0, backwards - slack), limit) * tangent;
}

}  // namespace calligraphy
