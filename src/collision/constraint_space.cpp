#include <calligraphy/collision/constraint_space.hpp>

namespace calligraphy {
namespace {

/// Wang 2006, sec. 4.3.1 (a)-(d) for an LSE. Sec. 4.3.2 gives a CSE a "spherical neighboring area around the start
/// point" without a radius; read here, as for an LSE, as the distance from its start to its end.
double printed_share(const StrokeElement& element, const Point& query) {
  if (!(element.size > 0.0)) return 1.0;  // (d)
  const Point edge = element.point(1.0) - element.origin;
  const Point from_start = query - element.origin;
  const bool ahead = element.degree > 1 || from_start.dot(edge) > 0.0;  // (a)
  const bool near = from_start.norm() < edge.norm();                    // (b), (c)
  return ahead && near ? 1.0 : 0.0;
}

}  // namespace

double guidance_share(const ConstraintSpace& space, const StrokeElement& element, const Point& query,
                      const NearestPoint& foot) noexcept {
  if (space.rule == ConstraintSpaceRule::wang2006) return printed_share(element, query);
  if (!(foot.distance < space.radius)) return 0.0;
  const double depth = space.radius - foot.distance;  // > 0: below the tube's edge
  if (depth >= space.edge) return 1.0;
  const double x = depth / space.edge;
  return x * x * (3.0 - 2.0 * x);
}

}  // namespace calligraphy
