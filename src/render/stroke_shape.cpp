#include "stroke_shape.hpp"

#include <algorithm>
#include <cmath>

namespace calligraphy {
namespace {

constexpr double shortest = 1e-9;         // that is divided by [em]
constexpr double least_roughness = 0.5;  // of a stroke that is hardly longer than a step, or doubles back
constexpr int parts = 16;                // of the way from node to node, as fine as a pen's at 1 kHz

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

ShapeNodes nodes_on(const WrittenPath& path, const Point& origin, double em) noexcept {
  const auto points = path.points();
  const auto arcs = path.arcs();
  const std::size_t kept = arcs.size();
  const double length = arcs[kept - 1] + (points[kept] - points[kept - 1]).norm();
  const double step = length / (ShapeNodes::count - 1), to_em = 1.0 / em;
  ShapeNodes nodes;
  std::size_t at = 0;
  for (std::size_t k = 0; k < ShapeNodes::count; ++k) {
    const double arc = step * static_cast<double>(k);
    while (at + 1 < kept && arc > arcs[at + 1]) ++at;
    const double size = (at + 1 < kept ? arcs[at + 1] : length) - arcs[at];
    const double share = size > 0.0 ? std::clamp((arc - arcs[at]) / size, 0.0, 1.0) : 0.0;
    const Point node = to_em * (points[at] + share * (points[at + 1] - points[at]) - origin);
    nodes.x[k] = node.x();
    nodes.y[k] = node.y();
  }
  return nodes;
}

StrokeShape shape_of(const ActiveStroke& stroke, double em) {
  StrokeShape shape;
  shape.origin = stroke.start();
  shape.em = em;
  shape.length = std::max(stroke.length() / em, shortest);
  Point before = shape.origin;
  WrittenPath exact;
  exact.begin(before, em, 0.0);
  for (std::size_t i = 0; i < ShapeNodes::count; ++i) {
    const Point point = stroke.at(stroke.length() * static_cast<double>(i) / (ShapeNodes::count - 1)).point;
    const Point node = (point - shape.origin) / em;
    shape.nodes.x[i] = node.x();
    shape.nodes.y[i] = node.y();
    for (int k = 1; k <= parts; ++k) exact.update(before + (point - before) * k / parts);
    before = point;
  }
  shape.roughness = std::max(least_roughness, roughness(shape.length - WrittenPath::spacing, shape.nodes));
  shape.bulge = shape.nodes.bulge();
  shape.chords = std::max(exact.chords() / em, shortest);
  return shape;
}

}  // namespace calligraphy
