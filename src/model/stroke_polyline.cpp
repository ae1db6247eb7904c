#include <calligraphy/model/stroke_polyline.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include <calligraphy/model/bezier.hpp>

namespace calligraphy {
namespace {

/// Number of equal parameter intervals that keep a curve within the tolerance of its chords, whose distance is at most
/// max |B''| / 8 / pieces^2.
template <int Degree>
int piece_count(const Bezier<Degree>& curve, double tolerance) {
  double bend = 0.0;
  for (const Point& second : curve.hodograph().hodograph().control_points) bend = std::max(bend, second.norm());
  return static_cast<int>(std::clamp(std::ceil(std::sqrt(bend / (8.0 * tolerance))), 1.0, 256.0));
}

template <int Degree>
void append_curve(std::span<const Point> control_points, double tolerance, std::vector<Point>& path) {
  Bezier<Degree> curve;
  std::copy_n(control_points.begin(), Degree + 1, curve.control_points.begin());
  const int pieces = piece_count(curve, tolerance);
  for (int piece = 1; piece <= pieces; ++piece) path.push_back(curve.point(static_cast<double>(piece) / pieces));
}

}  // namespace

std::vector<Point> stroke_polyline(const Stroke& stroke, double tolerance) {
  std::vector<Point> path{stroke.control_points.front()};
  std::span<const Point> rest = stroke.control_points;
  for (const char element : stroke.elements) {
    if (element == static_cast<char>(ElementKind::line)) {
      path.push_back(rest[1]);
      rest = rest.subspan(1);
      continue;
    }
    if (stroke.curve_degree == 3) {
      append_curve<3>(rest, tolerance, path);
    } else {
      append_curve<4>(rest, tolerance, path);
    }
    rest = rest.subspan(static_cast<std::size_t>(stroke.curve_degree));
  }
  return path;
}

}  // namespace calligraphy
