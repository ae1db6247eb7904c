#include "cubic_fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <calligraphy/model/bezier.hpp>

#include "polyline.hpp"

namespace calligraphy::recognition {
namespace {

/// Inner control points by linear least squares at given parameters, with fixed end points.
bool solve_handles(std::span<const Point> points, std::span<const double> parameters, Point handles[2]) {
  const Point& first = points.front();
  const Point& last = points.back();
  double a11 = 0.0, a12 = 0.0, a22 = 0.0;
  Point b1 = Point::Zero(), b2 = Point::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double t = parameters[i];
    const double s = 1.0 - t;
    const double w1 = 3.0 * s * s * t;
    const double w2 = 3.0 * s * t * t;
    const Point rest = points[i] - s * s * s * first - t * t * t * last;
    a11 += w1 * w1;
    a12 += w1 * w2;
    a22 += w2 * w2;
    b1 += w1 * rest;
    b2 += w2 * rest;
  }
  const double determinant = a11 * a22 - a12 * a12;
  if (!(determinant > 1e-9)) return false;
  handles[0] = (a22 * b1 - a12 * b2) / determinant;
  handles[1] = (a11 * b2 - a12 * b1) / determinant;
  return handles[0].allFinite() && handles[1].allFinite();
}

/// One Newton step of each parameter towards the closest point on the curve (Plass and Stone 1983).
void improve_parameters(std::span<const Point> points, const Bezier<3>& curve, std::vector<double>& parameters) {
  const Bezier<2> velocity = curve.hodograph();
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Point difference = curve.point(parameters[i]) - points[i];
    const Point tangent = velocity.point(parameters[i]);
    const double slope = tangent.squaredNorm() + difference.dot(velocity.derivative(parameters[i]));
    if (slope <= 0.0) continue;
    parameters[i] = std::clamp(parameters[i] - difference.dot(tangent) / slope, 0.0, 1.0);
  }
}

}  // namespace

double fit_cubic(std::span<const Point> points, Point handles[2]) {
  const Point& first = points.front();
  const Point& last = points.back();
  handles[0] = first + (last - first) / 3.0;
  handles[1] = last - (last - first) / 3.0;
  const double length = path_length(points);
  if (points.size() < 4 || length <= 0.0) return 0.0;
  std::vector<double> parameters(points.size(), 0.0);
  for (std::size_t i = 1; i < points.size(); ++i) {
    parameters[i] = parameters[i - 1] + (points[i] - points[i - 1]).norm() / length;
  }
  const Point straight[2] = {handles[0], handles[1]};
  for (int round = 0; round < 2; ++round) {
    Point next[2];
    if (!solve_handles(points, parameters, next)) break;
    // A handle far from the path would create a loop that is not in the drawing.
    if ((next[0] - first).norm() > 1.5 * length || (next[1] - last).norm() > 1.5 * length) {
      handles[0] = straight[0];
      handles[1] = straight[1];
      break;
    }
    handles[0] = next[0];
    handles[1] = next[1];
    improve_parameters(points, {{first, handles[0], handles[1], last}}, parameters);
  }
  const Bezier<3> curve{{first, handles[0], handles[1], last}};
  double largest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    largest = std::max(largest, (curve.point(parameters[i]) - points[i]).norm());
  }
  return largest;
}

}  // namespace calligraphy::recognition
