#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "import_measures.hpp"

namespace calligraphy::recognition {
namespace {

/// How far the path runs back along the source, as a share of the source's length. Every point of the path is projected
/// onto the source, within a quarter of its length from where it is expected.
double backward_share(std::span<const Point> path, std::span<const Point> source) {
  constexpr int projected = 48;
  constexpr int places = 161;
  constexpr double reach = 0.25;  // [1]
  const Path points = resampled(path, projected, 0.0, path_length(path));
  const Path along = resampled(source, places, 0.0, path_length(source));
  double farthest = 0.0;
  double back = 0.0;
  for (int i = 0; i < projected; ++i) {
    const double expected = static_cast<double>(i) / (projected - 1);
    const int first = std::max(0, static_cast<int>((expected - reach) * (places - 1)));
    const int last = std::min(places - 1, static_cast<int>((expected + reach) * (places - 1)));
    const auto squared = [&](int place) {
      return (points[static_cast<std::size_t>(i)] - along[static_cast<std::size_t>(place)]).squaredNorm();
    };
    int nearest = first;
    for (int place = first + 1; place <= last; ++place) {
      if (squared(place) < squared(nearest)) nearest = place;
    }
    const double at = static_cast<double>(nearest) / (places - 1);
    farthest = std::max(farthest, at);
    back = std::max(back, farthest - at);
  }
  return back;
}

/// A path at short equal steps, with the turn at each point [degree]: between a chord of length `window` that ends half
/// a window before the point, and one that begins half a window after it.
struct TurningPath {
  Path points;
  std::vector<double> turns;
};

TurningPath turning_path(std::span<const Point> path, double window) {
  constexpr double step = 0.005;  // [em]
  constexpr int most_points = 800;
  TurningPath result{resampled(path, step, most_points), {}};
  const Path& points = result.points;
  result.turns.assign(points.size(), 0.0);
  const double taken = path_length(path) / static_cast<double>(points.size() - 1);
  const auto half = static_cast<std::size_t>(std::max(1.0, std::round(0.5 * window / std::max(taken, 1e-12))));
  for (std::size_t i = 3 * half; i + 3 * half < points.size(); ++i) {
    const Point before = points[i - half] - points[i - 3 * half];
    const Point after = points[i + 3 * half] - points[i + half];
    result.turns[i] = std::abs(wrapped(direction_of(after) - direction_of(before)));
  }
  return result;
}

/// A turn of one path near which the other turns by less than half as much.
struct Corner {
  double inside;    ///< distance along its path from the nearer end [em]
  double distance;  ///< from the other path [em]
};

/// The turns of one path by more than `least` [degree] that the other lacks.
std::vector<Corner> corners_without_counterpart(const TurningPath& one, const TurningPath& other, double window,
                                                double least) {
  const double near = 2.0 * window + 0.02;  // [em]
  const double step = path_length(one.points) / static_cast<double>(one.points.size() - 1);
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    const double turn = one.turns[i];
    if (turn <= least) continue;
    bool is_peak = true;  // the first among equals
    for (std::size_t k = 0; k < one.points.size() && is_peak; ++k) {
      if (k == i || (one.points[k] - one.points[i]).norm() > window) continue;
      is_peak = one.turns[k] < turn || (one.turns[k] == turn && k > i);
    }
    if (!is_peak) continue;
    double counterpart = 0.0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < other.points.size(); ++k) {
      const double distance = (other.points[k] - one.points[i]).norm();
      nearest = std::min(nearest, distance);
      if (distance <= near) counterpart = std::max(counterpart, other.turns[k]);
    }
    if (counterpart >= 0.5 * turn) continue;
    corners.push_back({step * static_cast<double>(std::min(i, one.points.size() - 1 - i)), nearest});
  }
  return corners;
}

/// The sharpest turn between two successive segments, both longer than 1 % of the em [degree].
double sharpest_reversal(std::span<const Point> path) {
  constexpr double shortest = 0.01;  // [em]
  const Path points = without_repeats(path);
  double sharpest = 0.0;
  for (std::size_t i = 2; i < points.size(); ++i) {
    const Point before = points[i - 1] - points[i - 2];
    const Point after = points[i] - points[i - 1];
    if (before.norm() < shortest || after.norm() < shortest) continue;
    sharpest = std::max(sharpest, std::abs(wrapped(direction_of(after) - direction_of(before))));
  }
  return sharpest;
}

}  // namespace

StrokeMeasures measure_stroke(std::span<const Point> path, std::span<const Point> source, double half_width) {
  constexpr double false_corner = 25.0;  // [degree]
  constexpr double lost_corner = 60.0;   // [degree]
  constexpr double least_window = 0.02;  // [em]
  const double window = std::max(half_width, least_window);
  const TurningPath drawn = turning_path(path, window);
  const TurningPath wanted = turning_path(source, window);
  StrokeMeasures measures{};
  measures.backward = backward_share(path, source);
  measures.length = path_length(path);
  measures.source_length = path_length(source);
  measures.half_width = half_width;
  const std::vector<Corner> added = corners_without_counterpart(drawn, wanted, window, false_corner);
  const std::vector<Corner> lost = corners_without_counterpart(wanted, drawn, window, lost_corner);
  measures.false_corners = static_cast<int>(added.size());
  measures.lost_corners = static_cast<int>(lost.size());
  for (const Corner& corner : added) measures.false_distance = std::max(measures.false_distance, corner.distance);
  for (const Corner& corner : lost) measures.lost_inside = std::max(measures.lost_inside, corner.inside);
  measures.reversal = sharpest_reversal(source);
  return measures;
}

}  // namespace calligraphy::recognition
