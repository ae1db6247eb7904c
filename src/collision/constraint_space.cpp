#include <calligraphy/collision/constraint_space.hpp>

namespace calligraphy {

/// Wang 2006, sec. 4.3.1 (a)-(d) for an LSE. Sec. 4.3.2 gives a CSE a "spherical neighboring area around the start
/// point" without a radius; it is taken, as for an LSE, to be the distance from start to end.
double printed_weight(const StrokeElement& element, const Point& query, const NearestPoint& closest) noexcept {
  if (!(element.size() > 0.0)) return 1.0;  // (d)
  const bool ahead =
      element.degree() > 1 || closest.parameter > 0.0;  // (a): the closest point on a line is its projection
  const double reach = (element.point(1.0) - element.origin()).squaredNorm();
  const bool near = (query - element.origin()).squaredNorm() < reach;  // (b), (c)
  return ahead && near ? 1.0 : 0.0;
}

}  // namespace calligraphy
