// The path of a pen that writes a stroke, derived from the model alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <calligraphy/model/bezier.hpp>
#include <calligraphy/model/character.hpp>
#include <calligraphy/model/placed_character.hpp>

namespace calligraphy_test {

using calligraphy::Placement;
using calligraphy::Point;
using calligraphy::Stroke;

/// A stroke of the typical shape with this id, alone in a character.
inline calligraphy::Character typical_character(int id, std::vector<double> attraction_factors = {}) {
  calligraphy::StrokeInput input{id, {}, std::move(attraction_factors)};
  for (const auto& [x, y] : calligraphy::typical_stroke(id).shape) input.control_points.emplace_back(x, y);
  return calligraphy::make_character(U'\u4E00', std::span(&input, 1));
}

/// Points along the line from the last point of `path` to `to`, at most `step` apart.
inline void draw_line(std::vector<Point>& path, const Point& to, double step) {
  const Point from = path.back();
  const int count = std::max(1, static_cast<int>(std::ceil((to - from).norm() / step)));
  for (int i = 1; i <= count; ++i) path.push_back(from + (to - from) * i / count);
}

/// The path of a stroke on the page, with points at most `step` apart [m], feature points included.
inline std::vector<Point> path_of(const Stroke& stroke, const Placement& placement, double step) {
  std::vector<Point> path = {placement.to_page(stroke.control_points[0])};
  std::size_t at = 0;
  for (const char kind : stroke.elements) {
    if (kind == 'L') {
      draw_line(path, placement.to_page(stroke.control_points[++at]), step);
      continue;
    }
    const auto p = stroke.control_points.subspan(at, 4);
    const calligraphy::Bezier<3> curve{{p[0], p[1], p[2], p[3]}};
    for (int i = 1; i <= 100; ++i) draw_line(path, placement.to_page(curve.point(i / 100.0)), step);
    at += 3;
  }
  return path;
}

/// The path with a lateral offset: each point moved by `offset` to the left of the path direction there [m].
inline std::vector<Point> beside(const std::vector<Point>& path, double offset) {
  std::vector<Point> result;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Point direction = path[std::min(i + 1, path.size() - 1)] - path[i > 0 ? i - 1 : 0];
    const double length = direction.norm();
    const Point left = length > 0.0 ? Point(Point(-direction.y(), direction.x()) / length) : Point(0, 0);
    result.push_back(path[i] + offset * left);
  }
  return result;
}

}  // namespace calligraphy_test
