#include "stroke_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <Eigen/Geometry>

#include <calligraphy/judge/pen_path.hpp>

#include "resemblance.hpp"

namespace calligraphy {
namespace {

/// The points of a path that would need more are further apart than those of the line.
constexpr double max_path_points = 4000.0;
constexpr int max_moves = 10;
constexpr double min_move = 1e-3;   // of the line's length, and [rad]
constexpr double max_slant = 0.35;  // 20 degrees [rad]

/// Step by which an optimal alignment reached a pair of points.
enum class Move : std::uint8_t { begin, both, path, line };

struct Placed {
  Alignment alignment;
  Point path_mean = Point::Zero(), line_mean = Point::Zero();  ///< means over the pairs of points
  double turn = 0.0;  ///< turn of the path onto the line, by least squares over the pairs [rad]
};

Placed align_in_place(std::span<const Point> path, std::span<const Point> line) {
  const double spacing = path_length(line) / static_cast<double>(line.size() - 1);
  const double length = path_length(path);
  const double pieces = spacing > 0.0 ? std::clamp(std::ceil(length / spacing), 1.0, max_path_points) : 1.0;
  const auto rows = static_cast<std::size_t>(pieces) + 1, columns = line.size();
  const std::vector<Point> pen = points_along(path, length, rows);
  std::vector<Move> moves(rows * columns, Move::begin);
  std::vector<double> above, cost(columns);
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < columns; ++j) {
      double least = i == 0 ? 0.0 : std::numeric_limits<double>::infinity();
      Move from = Move::begin;
      const auto take = [&](double other, Move move) {
        if (other < least) least = other, from = move;
      };
      if (i > 0 && j > 0) take(above[j - 1], Move::both);
      if (i > 0) take(above[j], Move::path);
      if (i > 0 && j > 0) take(cost[j - 1], Move::line);
      cost[j] = least + (pen[i] - line[j]).norm();
      moves[i * columns + j] = from;
    }
    above = cost;
  }
  Placed placed;
  Alignment& result = placed.alignment;
  std::size_t i = rows - 1;
  auto j = static_cast<std::size_t>(std::min_element(cost.begin(), cost.end()) - cost.begin());
  const auto share = [columns](std::size_t column) {
    return static_cast<double>(column) / static_cast<double>(columns - 1);
  };
  result.end = share(j);
  std::vector<double> places(rows);
  double pairs = 0.0, sine = 0.0, cosine = 0.0;
  const Point origin = line.front();
  for (Move move = moves[i * columns + j];; move = moves[i * columns + j]) {
    places[i] = share(j);
    const Point drawn = pen[i] - origin, wanted = line[j] - origin;
    placed.path_mean += drawn;
    placed.line_mean += wanted;
    sine += cross(drawn, wanted);
    cosine += drawn.dot(wanted);
    ++pairs;
    if (move == Move::begin) break;
    if (move != Move::line) --i;
    if (move != Move::path) --j;
  }
  result.begin = share(j);
  placed.path_mean /= pairs;
  placed.line_mean /= pairs;
  placed.turn = std::atan2(sine - pairs * cross(placed.path_mean, placed.line_mean),
                           cosine - pairs * placed.path_mean.dot(placed.line_mean));
  placed.path_mean += origin;
  placed.line_mean += origin;
  // Places of the path's own points, from those at even steps along it.
  double along = 0.0;
  for (std::size_t k = 0; k < path.size(); ++k) {
    if (k > 0) along += (path[k] - path[k - 1]).norm();
    const double row = length > 0.0 ? along / length * pieces : 0.0;
    result.places.push_back(places[std::min(static_cast<std::size_t>(std::lround(row)), rows - 1)]);
  }
  return placed;
}

}  // namespace

Alignment align(std::span<const Point> path, std::span<const Point> line) {
  Placed placed = align_in_place(path, line);
  std::vector<Point> moved(path.begin(), path.end());
  const double length = path_length(line);
  for (const double max_turn : {0.0, max_slant}) {  // the turn can be determined once the path lies on the line
    double turned = 0.0;
    for (int i = 0; i < max_moves; ++i) {
      const bool begins = placed.alignment.begin == 0.0, ends = placed.alignment.end == 1.0;
      if (begins && ends) return placed.alignment;
      const double turn = std::clamp(turned + placed.turn, -max_turn, max_turn) - turned;
      turned += turn;
      const Eigen::Rotation2Dd rotation(turn);
      for (Point& point : moved) point = placed.path_mean + rotation * Point(point - placed.path_mean);
      const Point shift = begins
                              ? Point(line.front() - moved.front())
                              : (ends ? Point(line.back() - moved.back()) : Point(placed.line_mean - placed.path_mean));
      for (Point& point : moved) point += shift;
      if (shift.norm() <= min_move * length && std::abs(turn) <= min_move) break;
      placed = align_in_place(moved, line);
    }
  }
  return placed.alignment;
}

}  // namespace calligraphy
