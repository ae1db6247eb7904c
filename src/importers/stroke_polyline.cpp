#include "stroke_polyline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <calligraphy/model/bezier.hpp>
#include <calligraphy/model/typical_stroke.hpp>

namespace calligraphy::recognition {
namespace {

/// Number of pieces of equal parameter length that keep a cubic within the tolerance of its chords: max |B''| / 8 /
/// pieces^2 bounds the distance.
int pieces_of(const Bezier<3>& curve, double tolerance) {
  const auto& c = curve.control_points;
  const double bend = 6.0 * std::max((c[0] - 2.0 * c[1] + c[2]).norm(), (c[1] - 2.0 * c[2] + c[3]).norm());
  return static_cast<int>(std::clamp(std::ceil(std::sqrt(bend / (8.0 * tolerance))), 1.0, 256.0));
}

}  // namespace

Path flattened(const StrokeInput& stroke) {
  constexpr double tolerance = 1e-4;  // [em]
  const std::vector<Point>& control_points = stroke.control_points;
  Path path{control_points.front()};
  std::size_t at = 0;
  for (const char kind : stroke.composition().elements()) {
    if (kind == 'L') {
      path.push_back(control_points[++at]);
      continue;
    }
    const Bezier<3> curve{{control_points[at], control_points[at + 1], control_points[at + 2], control_points[at + 3]}};
    const int pieces = pieces_of(curve, tolerance);
    for (int piece = 1; piece <= pieces; ++piece) path.push_back(curve.point(static_cast<double>(piece) / pieces));
    at += 3;
  }
  return path;
}

}  // namespace calligraphy::recognition
