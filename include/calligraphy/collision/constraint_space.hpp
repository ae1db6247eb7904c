// Where a stroke element attracts the pen (Wang 2006, sec. 4.3.1 (a)-(d), 4.3.2).
#pragma once

#include <calligraphy/collision/nearest_point.hpp>

namespace calligraphy {

enum class ConstraintSpaceRule {
  tube,     ///< all within `radius` of the element, fading out over the last `fade_width` of it
  wang2006  ///< as printed: half disc round the start of an LSE, disc round the start of a CSE, no fading
};

struct ConstraintSpace {
  ConstraintSpaceRule rule = ConstraintSpaceRule::tube;
  double radius = 0.012;      ///< [m]
  double fade_width = 0.008;  ///< [m], at most `radius`; a narrow one drops the force steeply, a negative stiffness
};

/// Share of the guidance force that the pen feels at `query`: 1 inside, 0 outside, between them on the tube's edge,
/// where it is continuously differentiable. `closest` is the nearest point of the same element to the same query.
double guidance_weight(const ConstraintSpace& space, const StrokeElement& element, const Point& query,
                       const NearestPoint& closest) noexcept;

}  // namespace calligraphy
