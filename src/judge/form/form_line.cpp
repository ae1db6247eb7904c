#include "form_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include <calligraphy/judge/pen_path.hpp>

#include "judge/judge_constants.hpp"
#include "judge/pens/resemblance.hpp"

namespace calligraphy {
namespace {

using detail::judge_constants;

constexpr std::size_t smoothing = 8;   // eighths of a step on either side of a point of which it is the mean
constexpr std::size_t turn_reach = 3;  // points on either side over which a turn is measured
constexpr double no_length = 1e-6;     // [em]

/// The turn at a point, positive to the left [rad].
double turn_at(const FormLine& line, std::size_t i) {
  const Point before = line.points[i] - line.points[i - turn_reach];
  const Point after = line.points[i + turn_reach] - line.points[i];
  return std::atan2(cross(before, after), before.dot(after));
}

}  // namespace

Point FormLine::centre() const {
  Point sum = Point::Zero();
  for (const Point& point : points) sum += point;
  return sum / static_cast<double>(form_points);
}

FormLine form_line(const std::array<Point, form_points>& points) {
  FormLine line{points, {}, {}};
  for (std::size_t i = 0; i < form_points; ++i) {
    line.along[i] = i == 0 ? 0.0 : line.along[i - 1] + (points[i] - points[i - 1]).norm();
    line.box.extend(points[i]);
  }
  return line;
}

FormLine form_line(std::span<const Point> path) {
  constexpr std::size_t fine = 8;  // samples for each step
  const std::vector<Point> samples = points_along(path, path_length(path), (form_points - 1) * fine + 1);
  std::array<Point, form_points> points = {};
  for (std::size_t k = 0; k < form_points; ++k) {
    const std::size_t middle = k * fine, reach = std::min({smoothing, middle, samples.size() - 1 - middle});
    Point sum = Point::Zero();
    for (std::size_t i = middle - reach; i <= middle + reach; ++i) sum += samples[i];
    points[k] = sum / static_cast<double>(2 * reach + 1);
  }
  return form_line(points);
}

Eigen::AlignedBox2d box_of_lines(std::span<const FormLine> lines) {
  Eigen::AlignedBox2d box;
  for (const FormLine& line : lines) box.extend(line.box);
  return box;
}

std::vector<Crossing> crossings(const FormLine& one, const FormLine& other) {
  std::vector<Crossing> found;
  if (!one.box.intersects(other.box)) return found;
  for (std::size_t i = 0; i + 1 < form_points; ++i) {
    const Point from = one.points[i], step = one.points[i + 1] - from;
    const Point low = one.points[i].cwiseMin(one.points[i + 1]), high = one.points[i].cwiseMax(one.points[i + 1]);
    if ((low.array() > other.box.max().array()).any() || (high.array() < other.box.min().array()).any()) continue;
    for (std::size_t j = 0; j + 1 < form_points; ++j) {
      const Point other_step = other.points[j + 1] - other.points[j];
      const double area = cross(step, other_step);
      if (std::abs(area) <= 1e-12) continue;
      const Point between = other.points[j] - from;
      const double t = cross(between, other_step) / area, u = cross(between, step) / area;
      if (t < 0.0 || t > 1.0 || u < 0.0 || u > 1.0) continue;
      found.push_back({one.along[i] + t * (one.along[i + 1] - one.along[i]),
                       other.along[j] + u * (other.along[j + 1] - other.along[j])});
    }
  }
  return found;
}

NearestPlace nearest_place(const Point& point, const FormLine& line) {
  NearestPlace nearest{std::numeric_limits<double>::infinity(), 0.0, 0.0, line.points.front()};
  for (std::size_t i = 0; i + 1 < form_points; ++i) {
    const Point step = line.points[i + 1] - line.points[i], from = point - line.points[i];
    const double t = std::clamp(from.dot(step) / std::max(step.squaredNorm(), 1e-18), 0.0, 1.0);
    const Point off = from - t * step;
    const double distance = off.squaredNorm();
    if (distance >= nearest.distance) continue;
    const double area = cross(step, off);
    nearest = {distance, line.along[i] + t * (line.along[i + 1] - line.along[i]),
               area > 0.0 ? 1.0 : (area < 0.0 ? -1.0 : 0.0), line.points[i] + t * step};
  }
  nearest.distance = std::sqrt(nearest.distance);
  return nearest;
}

double least_distance(const FormLine& line, const FormLine& other) {
  double least = std::numeric_limits<double>::infinity();
  for (const Point& point : line.points) least = std::min(least, nearest_place(point, other).distance);
  return least;
}

namespace {

/// The distances of the points from the chord, positive to its left; zero if the ends are in one place.
std::array<double, form_points> offsets(const FormLine& line) {
  const Point chord = line.chord();
  const double length = chord.norm();
  std::array<double, form_points> found = {};
  for (std::size_t i = 0; i < form_points && length >= no_length; ++i) {
    found[i] = cross(chord, line.points[i] - line.points.front()) / length;
  }
  return found;
}

}  // namespace

double mean_offset(const FormLine& line) {
  const auto found = offsets(line);
  return std::accumulate(found.begin(), found.end(), 0.0) / static_cast<double>(form_points);
}

double bow(const FormLine& line) {
  double largest = 0.0;
  for (const double offset : offsets(line)) largest = std::max(largest, std::abs(offset));
  return mean_offset(line) < 0.0 ? -largest : largest;
}

std::optional<std::size_t> hook_of(const FormLine& line) {
  const double longest = std::min(judge_constants.max_hook_share * line.length(), judge_constants.max_hook_length);
  for (std::size_t i = form_points - 1 - turn_reach; i >= turn_reach; --i) {
    if (line.length() - line.along[i] > longest) return std::nullopt;
    if (std::abs(turn_at(line, i)) < judge_constants.min_hook_turn) continue;
    while (i > turn_reach && std::abs(turn_at(line, i - 1)) > std::abs(turn_at(line, i))) --i;
    return i;
  }
  return std::nullopt;
}

FormLine without_hook(const FormLine& line) {
  const std::optional<std::size_t> begin = hook_of(line);
  return begin ? form_line(std::span(line.points).first(*begin + 1)) : line;
}

}  // namespace calligraphy
