// The force terms, each a pure function (Wang 2006, sec. 5, eq. (7)-(9); sec. 2.2, Fig. 4).
#pragma once

#include <algorithm>
#include <cmath>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// Sign of eq. (8) and (9). The text at hand has lost its minus signs, so that the printed form is judged as it stands.
enum class ForceSign {
  attracting,  ///< towards the stroke and out of the paper
  wang2006     ///< as printed in the text that we have: away from the stroke, into the paper
};

/// In-plane attraction, eq. (8): K (X_s - X_p), scaled by the attraction factor and the share of the constraint space
/// [N]. As printed it is K (X_p - X_s).
inline Point attraction_force(double stiffness, const Point& tip, const Point& closest,
                              ForceSign sign = ForceSign::attracting) noexcept {
  return (sign == ForceSign::attracting ? stiffness : -stiffness) * (closest - tip);
}

/// A pull of `force` [N] by the linear law, kept below `limit` [N]: F / sqrt(1 + (F / limit)^2). The stiffness of eq.
/// (8) near the stroke; beyond limit / K the pull hardly grows any more, so that a device can give it at any distance.
inline Point saturated_force(const Point& force, double limit) noexcept {
  const double share = force.norm() / limit;
  return force / std::sqrt(1.0 + share * share);
}

/// Normal force, eq. (9): K d along the normal out of the paper, d = max(0, penetration) [N]. As printed, K (z_p - z_0)
/// for z_p >= z_0 along the axis of z_p itself, which draws the pen further in.
inline double normal_force(double stiffness, double penetration, ForceSign sign = ForceSign::attracting) noexcept {
  return (sign == ForceSign::attracting ? stiffness : -stiffness) * std::max(0.0, penetration);
}

/// Resistance against motion backwards along the stroke (Fig. 4): a spring along the tangent, forwards, from the
/// furthest point reached, after `slack`, never more than `limit` [N].
inline Point wrong_way_force(double stiffness, double limit, double slack, double backwards,
                             const Point& tangent) noexcept {
  return std::min(stiffness * std::max(0.0, backwards - slack), limit) * tangent;
}

}  // namespace calligraphy
