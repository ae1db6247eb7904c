#include <calligraphy/judge/dtw_distance.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/judge/pen_path.hpp>

#include "resemblance.hpp"

namespace calligraphy {
namespace {

constexpr std::size_t warped_points = 64;

std::vector<Point> warped_points_of(std::span<const Point> path, const std::string& name) {
  if (path.empty()) throw ValueError(name + ": a path without points");
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (!path[i].allFinite()) throw ValueError(name + "[" + std::to_string(i) + "] is not finite");
  }
  return points_along(path, path_length(path), warped_points);
}

}  // namespace

double dtw_distance(std::span<const Point> one, std::span<const Point> other) {
  const std::vector<Point> rows = warped_points_of(one, "one"), columns = warped_points_of(other, "other");
  constexpr double unreachable = std::numeric_limits<double>::infinity();
  std::array<double, warped_points + 1> above, sums;  // least weighted sums of two rows, from 1; 0 is their border
  above.fill(unreachable);
  above[0] = 0.0;
  for (const Point& row : rows) {
    sums[0] = unreachable;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const double cost = (row - columns[k]).norm();
      sums[k + 1] = std::min({above[k + 1] + cost, above[k] + 2.0 * cost, sums[k] + cost});
    }
    above = sums;
  }
  return above[warped_points] / static_cast<double>(rows.size() + columns.size());
}

}  // namespace calligraphy
