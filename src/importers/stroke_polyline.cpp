#include "stroke_polyline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <calligraphy/model/bezier.hpp>

namespace calligraphy::recognition {
namespace {

/// Number of pieces of equal parameter length that keep a cubic within the tolerance of its chords: max |B''| / 8 /
/// pieces^2 bounds the distance.
int pieces_of(const Bezier<3>& curve, double tolerance) {
  const auto& c = curve.control_points;
  const double bend = 6.0 * std::max((c[0] - 2.0 * c[1] + c[2]).norm(), (c[1] - 2.0 * c[2] + c[3]).norm());
  return static_cast<int>(std::clamp(std::ceil(std::sqrt(bend / (8.0 * tolerance))), 1.0, 256.0));
}

/// Bernstein polynomials of a cubic at t.
std::array<double, 4> weights_at(double t) {
  const double s = 1.0 - t;
  return {s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t};
}

}  // namespace

Path flattened(std::string_view elements, std::span<const Point> control_points, double tolerance) {
  Path path{control_points.front()};
  std::size_t at = 0;
  for (const char kind : elements) {
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

std::vector<StrokeChord> stroke_chords(std::string_view elements, int curve_steps) {
  std::vector<StrokeChord> chords;
  int at = 0;
  for (const char kind : elements) {
    if (kind == 'L') {
      chords.push_back({at, 2, {1.0, 0.0}, {0.0, 1.0}});
      at += 1;
      continue;
    }
    for (int step = 0; step < curve_steps; ++step) {
      const double width = 1.0 / curve_steps;
      chords.push_back({at, 4, weights_at(step * width), weights_at((step + 1) * width)});
    }
    at += 3;
  }
  return chords;
}

}  // namespace calligraphy::recognition
