#include "outline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace calligraphy::recognition {

namespace {

constexpr double touching = 1e-3;  // [em]; parts no farther apart are one

using Edges = std::vector<OutlineEdge>;

Edges edges_of(std::span<const Point> polygon) {
  Edges edges;
  edges.reserve(polygon.size());
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    edges.push_back({polygon[i], polygon[i + 1 == polygon.size() ? 0 : i + 1]});
  }
  return edges;
}

/// Of the point: edges that cross the ray to its right, upwards or downwards.
int winding_of(const Edges& edges, const Point& point) {
  int winding = 0;
  for (const OutlineEdge& edge : edges) {
    const Point from = edge.from - point, along = edge.to - edge.from;
    const double end = from.y() + along.y();
    const double side = along.x() * -from.y() + along.y() * from.x();  // of the point, left of the edge positive
    if (from.y() <= 0.0 && end > 0.0 && side > 0.0) ++winding;
    if (from.y() > 0.0 && end <= 0.0 && side < 0.0) --winding;
  }
  return winding;
}

/// Adds the positions along one edge, from 0 to 1, where the other crosses it or begins or ends on it.
void add_meetings(const OutlineEdge& one, const OutlineEdge& other, std::vector<double>& positions) {
  constexpr double on_edge = 1e-6;  // [em]
  const Point along = one.to - one.from, across = other.to - other.from, between = other.from - one.from;
  for (const Point& end : {other.from, other.to}) {
    const double position = (end - one.from).dot(along) / along.squaredNorm();
    if (position > 0.0 && position < 1.0 && (one.from + position * along - end).norm() < on_edge) {
      positions.push_back(position);
    }
  }
  const double turn = along.x() * across.y() - along.y() * across.x();
  if (turn == 0.0) return;
  const double position = (between.x() * across.y() - between.y() * across.x()) / turn;
  const double of_other = (between.x() * along.y() - between.y() * along.x()) / turn;
  if (position > 0.0 && position < 1.0 && of_other >= 0.0 && of_other <= 1.0) positions.push_back(position);
}

/// The edges in the same order, divided where they meet.
Edges divided(const Edges& edges) {
  Edges pieces;
  std::vector<double> positions;
  for (const OutlineEdge& edge : edges) {
    if (edge.from == edge.to) continue;
    positions.clear();
    for (const OutlineEdge& other : edges) add_meetings(edge, other, positions);
    std::sort(positions.begin(), positions.end());
    Point from = edge.from;
    for (const double position : positions) {
      const Point to = edge.from + position * (edge.to - edge.from);
      if (to != from) pieces.push_back({from, to});
      from = to;
    }
    pieces.push_back({from, edge.to});
  }
  return pieces;
}

/// True if there is ink on one side of the edge and none on the other, there and a little farther.
bool is_border(const OutlineEdge& edge, const Edges& all) {
  constexpr double beside = 1e-5;  // [em]
  const Point along = (edge.to - edge.from).normalized(), middle = 0.5 * (edge.from + edge.to);
  const Point left(-along.y(), along.x());
  const bool inked_left = winding_of(all, middle + beside * left) != 0;
  if (inked_left == (winding_of(all, middle - beside * left) != 0)) return false;
  return winding_of(all, middle + (inked_left ? -touching : touching) * left) == 0;
}

}  // namespace

Outline::Outline(std::span<const Point> polygon) : edges(edges_of(polygon)) {
  if (!polygon.empty()) starts.push_back(polygon.front());
}

Outline::Outline(std::span<const Path> polygons) {
  constexpr std::size_t most_vertices = 500, most_pieces = 4000;
  for (const Path& polygon : polygons) {
    const Edges part = edges_of(polygon);
    edges.insert(edges.end(), part.begin(), part.end());
    if (!polygon.empty()) starts.push_back(polygon.front());
  }
  if (starts.size() < 2 || edges.size() > most_vertices) return;
  Edges pieces = divided(edges);
  if (pieces.size() > most_pieces) return;
  for (OutlineEdge& piece : pieces) piece.is_border = is_border(piece, edges);
  edges = std::move(pieces);
}

Eigen::AlignedBox2d box_of(const Outline& outline) {
  Eigen::AlignedBox2d box;
  for (const OutlineEdge& edge : outline.edges) box.extend(edge.from);
  return box;
}

double inscribed_radius(const Outline& outline, const Point& point) {
  if (outline.edges.size() < 3) return 0.0;
  constexpr double none = std::numeric_limits<double>::infinity();
  double nearest = none, nearest_within = none;  // squared, of the border and of where parts touch
  for (const OutlineEdge& edge : outline.edges) {
    const Point from = edge.from - point, along = edge.to - edge.from;
    const double squared = along.squaredNorm();
    const double share = squared > 0.0 ? std::clamp(-from.dot(along) / squared, 0.0, 1.0) : 0.0;
    double& least = edge.is_border ? nearest : nearest_within;
    least = std::min(least, (from + share * along).squaredNorm());
  }
  const bool is_inked = nearest_within < touching * touching || winding_of(outline.edges, point) != 0;
  return is_inked && nearest < none ? std::sqrt(nearest) : 0.0;
}

double half_width(std::span<const Point> median, const Outline& outline) {
  constexpr int places = 21;  // the ends included, which do not count
  constexpr double most = 0.15;  // [1] of the length
  if (outline.empty()) return 0.0;
  const double length = path_length(median);
  std::vector<double> radii;
  const Path at = resampled(median, places, 0.0, length);
  for (std::size_t i = 1; i + 1 < at.size(); ++i) radii.push_back(inscribed_radius(outline, at[i]));
  const auto middle = radii.begin() + std::ssize(radii) / 2;
  std::nth_element(radii.begin(), middle, radii.end());
  return std::min(*middle, most * length);
}

BrushEnds brush_ends(std::span<const Point> median, const Outline& outline, double half_width) {
  constexpr double step = 0.004;    // [em]
  constexpr double reaches = 0.9;  // [1] of the way to the end; at a blunt end the disc touches both, but for rounding
  const auto reach_from = [&](const Path& path) {
    for (double at = step; at < half_width; at += step) {
      if (inscribed_radius(outline, point_after(path, 0, at)) < reaches * at) return at;
    }
    return half_width;
  };
  if (half_width <= 0.0) return {};
  return {reach_from(Path(median.begin(), median.end())), reach_from(Path(median.rbegin(), median.rend()))};
}

}  // namespace calligraphy::recognition
