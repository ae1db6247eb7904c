#include "waver.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <calligraphy/judge/pen_path.hpp>

#include "judge/pens/resemblance.hpp"
#include "laid_writing.hpp"

namespace calligraphy {
namespace {

constexpr double waver_step = 0.02;      // [em]
constexpr std::size_t course_reach = 6;  // steps on either side to which the course is fitted
constexpr std::size_t side_reach = 5;    // steps on either side over which the two sides are compared

/// The distance of one of the points from the straight line that fits them best, evenly along it, positive to its left.
double aside_of_course(std::span<const Point> points, std::size_t at) {
  const double middle = 0.5 * static_cast<double>(points.size() - 1);
  Point centre = Point::Zero(), slope = Point::Zero();
  double square = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double from_middle = static_cast<double>(k) - middle;
    centre += points[k];
    slope += from_middle * points[k];
    square += from_middle * from_middle;
  }
  centre /= static_cast<double>(points.size());
  slope /= square;
  const Point course = centre + (static_cast<double>(at) - middle) * slope;
  return cross(slope, points[at] - course) / std::max(slope.norm(), 1e-9);
}

}  // namespace

double waver(std::span<const Point> path, double length) {
  const auto steps = static_cast<std::size_t>(std::lround(length / waver_step));
  const std::vector<Point> points = points_along(path, path_length(path), steps + 1);
  const std::size_t last_course = points.size() - (2 * course_reach + 1);
  std::vector<double> aside;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t first = std::min(i - std::min(i, course_reach), last_course);
    aside.push_back(aside_of_course(std::span(points).subspan(first, 2 * course_reach + 1), i - first));
  }
  std::vector<double> squares;
  for (std::size_t i = 0; i < aside.size(); ++i) {
    const std::size_t first = i - std::min(i, side_reach), last = std::min(i + side_reach, aside.size() - 1);
    double left = 0.0, right = 0.0;
    for (std::size_t k = first; k <= last; ++k) (aside[k] > 0.0 ? left : right) += aside[k] * aside[k];
    squares.push_back(2.0 * std::min(left, right) / static_cast<double>(last - first + 1));
  }
  return median_of(std::move(squares));
}

}  // namespace calligraphy
