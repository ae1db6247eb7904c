#include "resemblance.hpp"

#include <algorithm>
#include <cmath>

#include <calligraphy/practice/pen_path.hpp>

namespace calligraphy {
namespace {

constexpr int steps_per_element = 24;

Point mean_of(const Outline& outline) {
  Point sum = Point::Zero();
  for (const Point& point : outline) sum += point;
  return sum / static_cast<double>(outline.size());
}

}  // namespace

void points_along(std::span<const Point> path, double length, std::span<Point> points) {
  const double step = length / static_cast<double>(points.size() - 1);
  double before = 0.0;  // length up to path[at]
  std::size_t at = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double wanted = step * static_cast<double>(k);
    double next = at + 1 < path.size() ? (path[at + 1] - path[at]).norm() : 0.0;
    while (at + 2 < path.size() && before + next < wanted) {
      before += next;
      ++at;
      next = (path[at + 1] - path[at]).norm();
    }
    const double share = next > 0.0 ? std::clamp((wanted - before) / next, 0.0, 1.0) : 0.0;
    points[k] = at + 1 < path.size() ? Point(path[at] + share * (path[at + 1] - path[at])) : path[at];
  }
}

std::vector<Point> points_along(std::span<const Point> path, double length, std::size_t count) {
  std::vector<Point> points(count);
  points_along(path, length, points);
  return points;
}

std::vector<Point> without_jitter(std::span<const Point> path, double spacing) {
  std::vector<Point> kept;
  for (const Point& point : path) {
    if (kept.empty() || (point - kept.back()).norm() >= spacing) kept.push_back(point);
  }
  if (!path.empty() && kept.back() != path.back()) kept.push_back(path.back());
  return kept;
}

Outline outline(std::span<const Point> path, double length) {
  Outline result;
  points_along(path, length, result);
  return result;
}

Outline outline(std::span<const Point> path) { return outline(path, path_length(path)); }

Outline reversed(const Outline& outline) {
  Outline result = outline;
  std::reverse(result.begin(), result.end());
  return result;
}

std::vector<Point> middle_line(const Stroke& stroke, const Placement& placement) {
  std::vector<Point> line;
  for (const StrokeElement& element : place_elements(stroke, placement)) {
    for (int i = line.empty() ? 0 : 1; i <= steps_per_element; ++i) {
      line.push_back(element.point(static_cast<double>(i) / steps_per_element));
    }
  }
  return line;
}

double mean_distance(const Outline& one, const Outline& other) {
  double sum = 0.0;
  for (std::size_t k = 0; k < one.size(); ++k) sum += (one[k] - other[k]).norm();
  return sum / static_cast<double>(one.size());
}

double accord(const Outline& one, const Outline& other) {
  const Point from = mean_of(one), to = mean_of(other);
  double product = 0.0, square = 0.0, other_square = 0.0;
  for (std::size_t k = 0; k < one.size(); ++k) {
    product += (one[k] - from).dot(other[k] - to);
    square += (one[k] - from).squaredNorm();
    other_square += (other[k] - to).squaredNorm();
  }
  const double size = std::sqrt(square * other_square);
  return size > 0.0 ? product / size : 0.0;
}

}  // namespace calligraphy
