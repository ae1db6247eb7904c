#include "label_place.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace calligraphy::svg {

double common_area(const Box& a, const Box& b) {
  const Point common = a.high.cwiseMin(b.high) - a.low.cwiseMax(b.low);
  return std::max(common.x(), 0.0) * std::max(common.y(), 0.0);
}

Box place_label(const Point& point, const Point& size, const Box& picture, const std::vector<Box>& taken) {
  constexpr double gap = 8.0, step = 9.0;  // [px]
  constexpr int farthest = 4;
  Box best = {};
  double covered = std::numeric_limits<double>::infinity();
  for (int away = 0; away < farthest; ++away) {
    const double across = 0.5 * size.x() + gap + step * away, up = 0.5 * size.y() + gap - 2.0 + step * away;
    for (const auto& [x, y] : {std::pair(1.0, 0.0), {-1.0, 0.0}, {0.0, -1.0}, {0.0, 1.0},
                               {1.0, -1.0}, {1.0, 1.0}, {-1.0, -1.0}, {-1.0, 1.0}}) {
      const Point middle = point + Point(x * across, y * up);
      const Box box = {middle - 0.5 * size, middle + 0.5 * size};
      double area = size.prod() - common_area(box, picture);
      for (const Box& other : taken) area += common_area(box, other);
      if (area < covered - 1e-9) {
        best = box;
        covered = area;
      }
    }
    if (covered < 1e-9) break;
  }
  return best;
}

}  // namespace calligraphy::svg
