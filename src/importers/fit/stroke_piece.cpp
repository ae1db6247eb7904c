#include "stroke_piece.hpp"

#include <algorithm>
#include <cmath>

#include <calligraphy/model/bezier.hpp>

namespace calligraphy::recognition {
namespace {

/// The points without the parts at either end that a rounded corner may have bent.
std::span<const Point> between_corners(std::span<const Point> points) {
  constexpr double corner_radius = 0.03;  // [em]
  const double reach = std::min(corner_radius, 0.15 * (points.back() - points.front()).norm());
  std::size_t first = 0;
  std::size_t last = points.size() - 1;
  while (first + 1 < last && (points[first] - points.front()).norm() < reach) ++first;
  while (last > first + 1 && (points[last] - points.back()).norm() < reach) --last;
  return points.subspan(first, last - first + 1);
}

/// Total least squares line: its forward direction [degree] and the maximum distance from it [em].
struct LineFit {
  double direction;
  double error;
};

LineFit fit_line(std::span<const Point> points) {
  Point mean = Point::Zero();
  for (const Point& point : points) mean += point;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (const Point& point : points) moments += (point - mean) * (point - mean).transpose();
  const double angle = 0.5 * std::atan2(2.0 * moments(0, 1), moments(0, 0) - moments(1, 1));
  const Point along(std::cos(angle), std::sin(angle));
  const Point normal(-along.y(), along.x());
  double largest = 0.0;
  for (const Point& point : points) largest = std::max(largest, std::abs(normal.dot(point - mean)));
  return {direction_of(along.dot(points.back() - points.front()) < 0.0 ? Point(-along) : along), largest};
}

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

/// Maximum distance of the points from their least-squares cubic with these end points.
double cubic_error(std::span<const Point> points) {
  const Point& first = points.front();
  const Point& last = points.back();
  const double length = path_length(points);
  if (points.size() < 4 || length <= 0.0) return 0.0;
  std::vector<double> parameters(points.size(), 0.0);
  for (std::size_t i = 1; i < points.size(); ++i) {
    parameters[i] = parameters[i - 1] + (points[i] - points[i - 1]).norm() / length;
  }
  const Bezier<3> straight{{first, first + (last - first) / 3.0, last - (last - first) / 3.0, last}};
  Bezier<3> curve = straight;
  for (int round = 0; round < 2; ++round) {
    Point next[2];
    if (!solve_handles(points, parameters, next)) break;
    // A handle far from the path would create a loop that is not in the drawing.
    if ((next[0] - first).norm() > 1.5 * length || (next[1] - last).norm() > 1.5 * length) {
      curve = straight;
      break;
    }
    curve = {{first, next[0], next[1], last}};
    improve_parameters(points, curve, parameters);
  }
  double largest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    largest = std::max(largest, (curve.point(parameters[i]) - points[i]).norm());
  }
  return largest;
}

/// Turn of the path at each point, between the chords of one window before and after it [degree].
std::vector<double> turns_along(const Path& path) {
  constexpr double window = 0.03;  // [em]
  std::vector<double> turns(path.size(), 0.0);
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const Point before = path[i] - point_before(path, i, window);
    const Point after = point_after(path, i, window) - path[i];
    turns[i] = std::abs(wrapped(direction_of(after) - direction_of(before)));
  }
  return turns;
}

Piece measure(std::span<const Point> points, std::span<const double> turns) {
  constexpr double corner_radius = 0.03;  // [em]
  Piece piece;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double nearest = std::min((points[i] - points.front()).norm(), (points[i] - points.back()).norm());
    if (nearest > corner_radius) piece.sharpest = std::max(piece.sharpest, turns[i]);
  }
  const Point chord = points.back() - points.front();
  piece.length = chord.norm();
  piece.direction = direction_of(chord);
  const auto third = std::max<std::size_t>(1, points.size() / 3);
  piece.leaving = direction_of(points[third] - points.front());
  piece.arriving = direction_of(points.back() - points[points.size() - 1 - third]);
  piece.bulge = bulge_of(points, piece.length);
  const LineFit line = fit_line(between_corners(points));
  piece.line_direction = line.direction;
  piece.line_error = line.error;
  piece.cubic_error = cubic_error(points);
  return piece;
}

}  // namespace

double bulge_of(std::span<const Point> points, double chord) {
  if (chord <= 0.0) return 0.0;
  double area = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point a = points[i - 1] - points.front();
    const Point b = points[i] - points.front();
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  // The area is positive if the path lies left of its chord.
  return -area / (chord * chord);
}

PieceTable::PieceTable(const Path& path, std::span<const std::size_t> corners) : count_(corners.size()) {
  pieces_.resize(count_ * count_);
  const std::vector<double> turns = turns_along(path);
  for (std::size_t from = 0; from < count_; ++from) {
    for (std::size_t to = from + 1; to < count_; ++to) {
      const std::size_t points = corners[to] - corners[from] + 1;
      pieces_[from * count_ + to] =
          measure(std::span(path).subspan(corners[from], points), std::span(turns).subspan(corners[from], points));
    }
  }
}

}  // namespace calligraphy::recognition
