// The area of the outline of a stroke, by which useless ones are told; private to the importers.
#pragma once

#include <cmath>
#include <vector>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

inline constexpr double least_outline_area = 1e-5;  // [em^2]; the smallest of hanzi-writer-data has 7e-4

/// Positive if the polygon runs counter-clockwise.
inline double signed_area(const std::vector<Point>& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point from = polygon[i] - polygon[0], to = polygon[i + 1 < polygon.size() ? i + 1 : 0] - polygon[0];
    twice += from.x() * to.y() - from.y() * to.x();
  }
  return 0.5 * twice;
}

/// Of all polygons, holes included.
inline double area_of(const std::vector<std::vector<Point>>& polygons) {
  double area = 0.0;
  for (const std::vector<Point>& polygon : polygons) area += std::abs(signed_area(polygon));
  return area;
}

}  // namespace calligraphy
