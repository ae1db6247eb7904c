#include "outline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace calligraphy::recognition {

double inscribed_radius(std::span<const Point> outline, const Point& point) {
  if (outline.size() < 3) return 0.0;
  int winding = 0;
  double nearest = (outline.front() - point).squaredNorm();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point from = outline[i] - point;
    const Point along = outline[i + 1 == outline.size() ? 0 : i + 1] - outline[i];
    const double end = from.y() + along.y();
    // Edges that cross the ray to the right of the point, upwards or downwards.
    const double side = along.x() * -from.y() + along.y() * from.x();  // of the point, left of the edge positive
    if (from.y() <= 0.0 && end > 0.0 && side > 0.0) ++winding;
    if (from.y() > 0.0 && end <= 0.0 && side < 0.0) --winding;
    const double squared = along.squaredNorm();
    const double share = squared > 0.0 ? std::clamp(-from.dot(along) / squared, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, (from + share * along).squaredNorm());
  }
  return winding == 0 ? 0.0 : std::sqrt(nearest);
}

double half_width(std::span<const Point> median, std::span<const Point> outline) {
  constexpr int places = 21;  // the ends included, which do not count
  constexpr double most = 0.15;  // [1] of the length
  if (outline.empty()) return 0.0;
  const double length = path_length(median);
  std::vector<double> radii;
  const Path at = resampled(median, places, 0.0, length);
  for (std::size_t i = 1; i + 1 < at.size(); ++i) radii.push_back(inscribed_radius(outline, at[i]));
  const auto middle = radii.begin() + std::ssize(radii) / 2;
  std::nth_element(radii.begin(), middle, radii.end());
  return std::min(*middle, most * length);
}

BrushEnds brush_ends(std::span<const Point> median, std::span<const Point> outline, double half_width) {
  constexpr double step = 0.004;    // [em]
  constexpr double reaches = 0.9;  // [1] of the way to the end; at a blunt end the disc touches both, but for rounding
  const auto reach_from = [&](const Path& path) {
    for (double at = step; at < half_width; at += step) {
      if (inscribed_radius(outline, point_after(path, 0, at)) < reaches * at) return at;
    }
    return half_width;
  };
  if (half_width <= 0.0) return {};
  return {reach_from(Path(median.begin(), median.end())), reach_from(Path(median.rbegin(), median.rend()))};
}

}  // namespace calligraphy::recognition
