#include "stroke_shape.hpp"

#include <algorithm>
#include <cmath>

#include "written_path.hpp"

namespace calligraphy {
namespace {

constexpr double shortest = 1e-9;         // that is divided by [em]
constexpr double least_roughness = 0.5;  // of a stroke that is hardly longer than a step, or doubles back
constexpr int parts = 8;                  // of a step along a stroke, as fine as a pen's at 1 kHz

}  // namespace

double ShapeNodes::bulge() const noexcept {
  const Point way = chord();
  const double length = way.norm();
  double most = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Point from = at(i) - at(0);
    const double off = length > shortest ? std::abs(way.x() * from.y() - way.y() * from.x()) / length : from.norm();
    most = std::max(most, off);
  }
  return most;
}

double ShapeNodes::coarse_length() const noexcept {
  constexpr std::size_t apart = count / 4;
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < count; i += apart) length += (at(std::min(i + apart, count - 1)) - at(i)).norm();
  return std::max(length, shortest);
}

ShapeNodes nodes_on(std::span<const Point> points, const Point& origin, double em) noexcept {
  std::array<double, WrittenPath::capacity + 1> arcs;
  arcs[0] = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) arcs[i] = arcs[i - 1] + (points[i] - points[i - 1]).norm();
  ShapeNodes nodes;
  const double step = arcs[points.size() - 1] / (ShapeNodes::count - 1), to_em = 1.0 / em;
  std::size_t at = 0;
  for (std::size_t k = 0; k < ShapeNodes::count; ++k) {
    const double arc = step * static_cast<double>(k);
    while (at + 2 < points.size() && arc > arcs[at + 1]) ++at;
    const double size = arcs[at + 1] - arcs[at];
    const double share = size > 0.0 ? std::clamp((arc - arcs[at]) / size, 0.0, 1.0) : 0.0;
    const Point node = to_em * (points[at] + share * (points[at + 1] - points[at]) - origin);
    nodes.x[k] = node.x();
    nodes.y[k] = node.y();
  }
  return nodes;
}

StrokeShape shape_of(const ActiveStroke& stroke, double em) {
  std::array<Point, WrittenPath::capacity> points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = stroke.at(stroke.length() * static_cast<double>(i) / (points.size() - 1)).point;
  }
  StrokeShape shape;
  shape.origin = points.front();
  shape.em = em;
  shape.length = std::max(stroke.length() / em, shortest);
  shape.nodes = nodes_on(points, shape.origin, em);
  shape.roughness = std::max(least_roughness, roughness(shape.length - WrittenPath::spacing, shape.nodes));
  shape.bulge = shape.nodes.bulge();
  WrittenPath exact;
  exact.begin(shape.origin, em, 0.0);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point step = (points[i] - points[i - 1]) / parts;
    for (int k = 1; k <= parts; ++k) exact.update(points[i - 1] + k * step, points[i - 1] + k * step);
  }
  shape.chords = std::max(exact.chords() / em, shortest);
  return shape;
}

}  // namespace calligraphy
