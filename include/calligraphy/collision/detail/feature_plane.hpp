// The plane that ends a stroke element (Wang 2006, sec. 4.3, Fig. 17, eq. (6)).
#pragma once

#include <calligraphy/collision/stroke_element.hpp>

namespace calligraphy::detail {

/// Plane through a feature point, perpendicular to the element that ends there.
struct FeaturePlane {
  Point point = Point::Zero();
  Point normal = Point::Zero();  ///< the element's unit tangent at its end; zero for a point

  /// Signed distance of `query` from the plane: V_t . V_f of eq. (6), positive once the feature point has been passed.
  double signed_distance(const Point& query) const noexcept { return normal.dot(query - point); }
};

inline FeaturePlane end_plane(const StrokeElement& element) noexcept {
  return {element.point(1.0), element.tangent(1.0)};
}

}  // namespace calligraphy::detail
