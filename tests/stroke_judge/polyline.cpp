#include "polyline.hpp"

#include <algorithm>
#include <cmath>

namespace calligraphy_test {

using namespace calligraphy;

namespace {

struct Place {
  std::size_t before;  ///< the last point that is not beyond it
  Point point;
};

Place place_at(const PenPath& path, double share) {
  double left = share * path_length(path);
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const double step = (path[i + 1] - path[i]).norm();
    if (left < step) return {i, path[i] + left / step * (path[i + 1] - path[i])};
    left -= step;
  }
  return {path.size() - 1, path.back()};
}

}  // namespace

Box box_of(const PenPath& path) {
  Box box;
  for (const Point& point : path) box.extend(point);
  return box;
}

Box box_of(std::span<const PenPath> paths) {
  Box box;
  for (const PenPath& path : paths) box.extend(box_of(path));
  return box;
}

double chord(const PenPath& path) { return (path.back() - path.front()).norm(); }

Point point_at(const PenPath& path, double share) { return place_at(path, share).point; }

std::pair<PenPath, PenPath> cut(const PenPath& path, double share) {
  const Place place = place_at(path, share);
  const auto after = path.begin() + static_cast<std::ptrdiff_t>(place.before) + 1;
  PenPath first(path.begin(), after), second{place.point};
  first.push_back(place.point);
  second.insert(second.end(), after, path.end());
  return {first, second};
}

PenPath straight_line(const Point& from, const Point& to) {
  const int steps = std::max(1, static_cast<int>(std::ceil((to - from).norm() / 0.01)));
  PenPath path;
  for (int i = 0; i <= steps; ++i) path.push_back(from + (to - from) * i / steps);
  return path;
}

}  // namespace calligraphy_test
