#include "resemblance.hpp"

#include <algorithm>
#include <array>

#include <Eigen/Geometry>

#include <calligraphy/judge/pen_path.hpp>
#include <calligraphy/model/element_list.hpp>

namespace calligraphy {
namespace {

constexpr int steps_per_element = 24;
constexpr Eigen::Index samples_per_piece = 8;

/// Sets points on a path that are `step` apart along it, the first one `begin` from its start.
void walk(std::span<const Point> path, double begin, double step, std::span<Point> points) {
  double before = 0.0;  // length up to path[at]
  std::size_t at = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double wanted = begin + step * static_cast<double>(k);
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

/// Appends the points of a line or a curve at even steps of its parameter, without its start.
void append_element(std::span<const Point> control_points, std::vector<Point>& line) {
  // In powers of the parameter, relative to the start and the size.
  const Point origin = control_points.front();
  Eigen::AlignedBox2d box;
  for (const Point& point : control_points) box.extend(point);
  const bool is_line = control_points.size() == 2;
  const double size = is_line ? 1.0 : box.sizes().norm(), per_size = 1.0 / size;
  std::vector<Point> differences, coefficients;
  for (const Point& point : control_points) differences.push_back((point - origin) * per_size);
  double binomial = 1.0;
  const std::size_t degree = control_points.size() - 1;
  for (std::size_t k = 1; k <= degree; ++k) {
    binomial = binomial * static_cast<double>(degree + 1 - k) / static_cast<double>(k);
    for (std::size_t i = 0; i + k <= degree; ++i) differences[i] = differences[i + 1] - differences[i];
    coefficients.push_back(binomial * differences[0]);
  }
  for (int i = 1; i <= steps_per_element; ++i) {
    const double t = static_cast<double>(i) / steps_per_element;
    Point sum = Point::Zero();
    for (std::size_t k = degree; k-- > 0;) sum = (sum + coefficients[k]) * t;
    line.push_back(size > 0.0 ? Point(origin + size * sum) : origin);
  }
}

}  // namespace

std::vector<Point> points_along(std::span<const Point> path, double length, std::size_t count) {
  std::vector<Point> points(count);
  walk(path, 0.0, length / static_cast<double>(count - 1), points);
  return points;
}

Point halfway(std::span<const Point> path) { return points_along(path, path_length(path), 3)[1]; }

std::vector<Point> without_jitter(std::span<const Point> path, double spacing) {
  std::vector<Point> kept;
  for (const Point& point : path) {
    if (kept.empty() || (point - kept.back()).norm() >= spacing) kept.push_back(point);
  }
  if (!path.empty() && kept.back() != path.back()) kept.push_back(path.back());
  return kept;
}

Outline outline(std::span<const Point> path, double length) {
  std::array<Point, static_cast<std::size_t>(Outline::RowsAtCompileTime * samples_per_piece)> samples;
  const double step = length / static_cast<double>(samples.size());
  walk(path, 0.5 * step, step, samples);
  Outline result = Outline::Zero();
  for (std::size_t k = 0; k < samples.size(); ++k) {
    result.row(static_cast<Eigen::Index>(k) / samples_per_piece) += samples[k].transpose() / samples_per_piece;
  }
  return result;
}

Outline outline(std::span<const Point> path) { return outline(path, path_length(path)); }

double length_of(const Outline& outline) {
  constexpr Eigen::Index steps = Outline::RowsAtCompileTime - 1;
  const double between = (outline.bottomRows<steps>() - outline.topRows<steps>()).rowwise().norm().sum();
  return between * (steps + 1) / steps;
}

Outline reversed(const Outline& outline) { return outline.colwise().reverse(); }

Outline centred(const Outline& outline) {
  const Outline moved = outline.rowwise() - outline.colwise().mean();
  return moved / std::max(moved.norm(), 1e-9);
}

std::vector<Point> middle_line(const Stroke& stroke, const Placement& placement) {
  std::vector<Point> line = {placement.to_page(stroke.control_points.front())};
  const std::vector<int> ends = feature_points(stroke.elements, stroke.curve_degree);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    std::vector<Point> points;
    for (int k = ends[i]; k <= ends[i + 1]; ++k) {
      points.push_back(placement.to_page(stroke.control_points[static_cast<std::size_t>(k)]));
    }
    append_element(points, line);
  }
  return line;
}

std::vector<std::vector<Point>> middle_lines(const Character& character) {
  std::vector<std::vector<Point>> lines;
  for (const Stroke& stroke : strokes(character)) lines.push_back(middle_line(stroke));
  return lines;
}

double mean_distance(const Outline& one, const Outline& other) {
  const Eigen::Array<double, Outline::RowsAtCompileTime, 2> apart = one - other;
  return (apart.col(0).square() + apart.col(1).square()).sqrt().mean();
}

double accord(const Outline& one, const Outline& other) { return one.cwiseProduct(other).sum(); }

}  // namespace calligraphy
