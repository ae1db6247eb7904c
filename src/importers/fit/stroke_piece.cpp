#include "stroke_piece.hpp"

#include <algorithm>
#include <cmath>

#include "cubic_fit.hpp"

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
  const auto [through, along] = line_through(points);
  const Point normal(-along.y(), along.x());
  double largest = 0.0;
  for (const Point& point : points) largest = std::max(largest, std::abs(normal.dot(point - through)));
  return {direction_of(along.dot(points.back() - points.front()) < 0.0 ? Point(-along) : along), largest};
}

/// Turn of the path at each point, between the chords of one window before and after it [degree].
std::vector<double> turns_along(const Path& path) {
  constexpr double window = 0.03;  // [em]
  const Path reversed(path.rbegin(), path.rend());
  std::vector<double> turns(path.size(), 0.0);
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const Point before = path[i] - point_after(reversed, path.size() - 1 - i, window);
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
  Point handles[2];
  piece.cubic_error = fit_cubic(points, handles);
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
