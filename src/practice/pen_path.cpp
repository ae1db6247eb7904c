#include <calligraphy/practice/pen_path.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "pen_down.hpp"

namespace calligraphy {
namespace {

constexpr double flat = 0.15;        // a side of a box below this is flat [em]
constexpr double max_stretch = 1.5;  // of one axis against the other

Eigen::AlignedBox2d box_of(std::span<const PenPath> paths) {
  Eigen::AlignedBox2d written, everything;
  for (const PenPath& path : paths) {
    const bool counts = path_length(path) >= tap_length;
    for (const Point& point : path) {
      everything.extend(point);
      if (counts) written.extend(point);
    }
  }
  return written.isEmpty() ? everything : written;
}

}  // namespace

double path_length(std::span<const Point> path) noexcept {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

std::vector<PenPath> pen_paths(const PenTrace& trace) {
  std::vector<PenPath> paths;
  for (const PenStroke& stroke : trace.strokes) {
    if (stroke.empty()) continue;
    PenPath& path = paths.emplace_back();
    for (const TimedPoint& timed : stroke) path.push_back(timed.point);
  }
  return paths;
}

std::vector<PenPath> pen_paths(const Recording& recording, const Placement& placement) {
  std::vector<PenPath> paths;
  for (const PenDown& down : pen_downs(recording)) {
    PenPath& path = paths.emplace_back();
    for (const TimedPoint& sample : down.samples) path.push_back((sample.point - placement.origin) / placement.em);
  }
  return paths;
}

BoxMap fit_box(std::span<const PenPath> paths, const Character& character) {
  BoxMap map;
  const Eigen::AlignedBox2d from = box_of(paths);
  if (from.isEmpty()) return map;
  const Eigen::AlignedBox2d to = bounding_box({character, {Point::Zero(), 1.0}});
  const Point sides = from.sizes(), wanted = to.sizes();
  const bool flat_x = std::min(sides.x(), wanted.x()) < flat, flat_y = std::min(sides.y(), wanted.y()) < flat;
  if (!flat_x) map.scale.x() = wanted.x() / sides.x();
  if (!flat_y) map.scale.y() = wanted.y() / sides.y();
  if (flat_x) map.scale.x() = map.scale.y();
  if (flat_y) map.scale.y() = map.scale.x();
  const double mean = std::sqrt(map.scale.x() * map.scale.y());
  const double limit = std::sqrt(max_stretch);
  const double stretch = std::clamp(std::sqrt(map.scale.x() / map.scale.y()), 1.0 / limit, limit);
  map.scale = {mean * stretch, mean / stretch};
  map.offset = to.center() - map.scale.cwiseProduct(from.center());
  return map;
}

}  // namespace calligraphy
