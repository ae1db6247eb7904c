// The region in which a stroke element attracts the pen (Wang 2006, sec. 4.3.1 (a)-(d), 4.3.2).
#pragma once

#include <calligraphy/collision/nearest_point.hpp>

namespace calligraphy {

enum class ConstraintSpaceRule {
  tube,     ///< everything within `radius` of the element, fading out over the outermost `fade_width`
  wang2006  ///< as printed: half disc around the start of an LSE, disc around the start of a CSE, no fading
};

struct ConstraintSpace {
  ConstraintSpaceRule rule = ConstraintSpaceRule::tube;
  double radius = 0.3;      ///< [em]
  double fade_width = 0.2;  ///< at most `radius`; a narrow one lets the force drop steeply, a negative stiffness [em]
};

/// guidance_weight() as printed.
double printed_weight(const StrokeElement& element, const Point& query, const NearestPoint& closest) noexcept;

/// Factor on the guidance force at `query`: 1 inside, 0 outside, continuously differentiable in between, at the edge of
/// the tube. `closest` is the nearest point of the same element to the same query, `em` the edge of the em square [m].
inline double guidance_weight(const ConstraintSpace& space, double em, const StrokeElement& element, const Point& query,
                              const NearestPoint& closest) noexcept {
  if (space.rule == ConstraintSpaceRule::wang2006) return printed_weight(element, query, closest);
  const double radius = space.radius * em, fade_width = space.fade_width * em;
  if (!(closest.distance < radius)) return 0.0;
  const double depth = radius - closest.distance;  // > 0: inside the edge of the tube
  if (depth >= fade_width) return 1.0;
  const double x = depth / fade_width;
  return x * x * (3.0 - 2.0 * x);
}

}  // namespace calligraphy
