#include "thinned.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace calligraphy {
namespace {

double distance_to_chord(const Point& point, const Point& begin, const Point& end) {
  const Point chord = end - begin;
  const double square = chord.squaredNorm();
  const double t = square > 0.0 ? std::clamp((point - begin).dot(chord) / square, 0.0, 1.0) : 0.0;
  return (point - begin - t * chord).norm();
}

}  // namespace

std::vector<Point> thinned(const std::vector<Point>& path, double tolerance) {
  if (path.empty()) return {};
  std::vector<bool> kept(path.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, path.size() - 1}};
  while (!open.empty()) {
    const auto [begin, end] = open.back();
    open.pop_back();
    std::size_t furthest = begin;
    double largest = tolerance;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const double distance = distance_to_chord(path[i], path[begin], path[end]);
      if (distance <= largest) continue;
      largest = distance;
      furthest = i;
    }
    if (furthest == begin) continue;
    kept[furthest] = true;
    open.push_back({begin, furthest});
    open.push_back({furthest, end});
  }
  std::vector<Point> result;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (kept[i]) result.push_back(path[i]);
  }
  return result;
}

}  // namespace calligraphy
