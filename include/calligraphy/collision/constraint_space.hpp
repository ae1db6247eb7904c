// The region in which a stroke element attracts the pen (Wang 2006, sec. 4.3.1 (a)-(d), 4.3.2).
#pragma once

#include <calligraphy/collision/nearest_point.hpp>
#include <calligraphy/collision/rules.hpp>

namespace calligraphy {

/// A tube around a stroke element, within which the element attracts the pen. Unused under the printed rules (Rules).
struct ConstraintSpace {
  double radius = 0.3;  ///< distance from the stroke beyond which it does not attract the pen [em]
  /// Width of the edge of the tube in which the force fades out, at most `radius` [em]. A narrow edge makes it drop
  /// steeply, which amounts to a negative stiffness.
  double fade_width = 0.2;
};

/// guidance_weight() as printed: a half disc around the start of an LSE, a disc around that of a CSE, no fading.
double printed_weight(const StrokeElement& element, const Point& query, const NearestPoint& closest) noexcept;

/// Factor on the guidance force at `query`: 1 inside, 0 outside, continuously differentiable in between, at the edge of
/// the tube. `closest` is the nearest point of the same element to the same query, `em` the edge of the em square [m].
inline double guidance_weight(const ConstraintSpace& space, double em, const StrokeElement& element, const Point& query,
                              const NearestPoint& closest, Rules rules = Rules::revised) noexcept {
  if (is_printed(rules)) return printed_weight(element, query, closest);
  const double radius = space.radius * em, fade_width = space.fade_width * em;
  if (!(closest.distance < radius)) return 0.0;
  const double depth = radius - closest.distance;  // > 0: inside the edge of the tube
  if (depth >= fade_width) return 1.0;
  const double x = depth / fade_width;
  return x * x * (3.0 - 2.0 * x);
}

}  // namespace calligraphy
