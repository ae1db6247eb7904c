#include <calligraphy/judge/pen_path.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/placed_character.hpp>

#include "base/require.hpp"
#include "judge/judge_constants.hpp"
#include "pen_paths.hpp"

namespace calligraphy {
namespace {

using detail::judge_constants;

/// The box without taps, unless there is nothing else.
Eigen::AlignedBox2d box_of(std::span<const PenPath> paths) {
  const double tap = tap_length * shortening(paths);
  Eigen::AlignedBox2d written;
  for (const PenPath& path : paths) {
    if (path_length(path) < tap) continue;
    for (const Point& point : path) written.extend(point);
  }
  return written.isEmpty() ? box_of_all(paths) : written;
}

/// The side below which a box is flat.
double flat_below(const Eigen::AlignedBox2d& box) {
  return judge_constants.box_flat_side * std::min(1.0, box.sizes().maxCoeff());
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
    if (stroke.empty() || is_erasing(stroke)) continue;
    PenPath& path = paths.emplace_back();
    for (const TimedPoint& timed : stroke) path.push_back(timed.point);
  }
  return paths;
}

void require_paths(std::span<const PenPath> paths) {
  constexpr std::size_t max_paths = 1000;
  constexpr double max_coordinate = 1e9;  // [em]
  if (paths.size() > max_paths) {
    throw ValueError(std::to_string(paths.size()) + " pen-downs: expected at most " + std::to_string(max_paths));
  }
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const std::string pen_down = "pen-down " + std::to_string(i + 1);
    if (paths[i].empty()) throw ValueError(pen_down + " has no point");
    for (const Point& point : paths[i]) {
      if (!point.allFinite()) throw ValueError(pen_down + " has a point that is not finite");
      if (point.cwiseAbs().maxCoeff() > max_coordinate) {
        throw ValueError(pen_down + " has a point " + number_text(point.cwiseAbs().maxCoeff()) +
                         " em away, expected at most " + number_text(max_coordinate));
      }
    }
  }
}

BoxMap fit_box(std::span<const PenPath> paths, const Character& character) {
  BoxMap map;
  const Eigen::AlignedBox2d from = box_of(paths);
  if (from.isEmpty()) return map;
  const Eigen::AlignedBox2d to = bounding_box({character, {Point::Zero(), 1.0}});
  const Point sides = from.sizes(), wanted = to.sizes();
  const double flat_side = flat_below(from), flat_wanted = flat_below(to);
  const bool flat_x = sides.x() < flat_side || wanted.x() < flat_wanted;
  const bool flat_y = sides.y() < flat_side || wanted.y() < flat_wanted;
  if (!flat_x) map.scale.x() = wanted.x() / sides.x();
  if (!flat_y) map.scale.y() = wanted.y() / sides.y();
  if (flat_x) map.scale.x() = map.scale.y();
  if (flat_y) map.scale.y() = map.scale.x();
  const double mean = std::sqrt(map.scale.x() * map.scale.y());
  const double limit = std::sqrt(judge_constants.max_box_stretch);
  const double stretch = std::clamp(std::sqrt(map.scale.x() / map.scale.y()), 1.0 / limit, limit);
  map.scale = {mean * stretch, mean / stretch};
  map.offset = to.center() - map.scale.cwiseProduct(from.center());
  return map;
}

}  // namespace calligraphy
