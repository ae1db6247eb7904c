#include "stroke_measures.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace calligraphy::recognition {
namespace {

/// How far the path runs back along the source, as a share of the source's length. Every point of the path is projected
/// to the source within a quarter of its length about where it should be.
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

/// A path at short equal steps, with its turn at each point: between the chords of length `window` that end, and begin,
/// half of it before and after the point [degree].
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

/// Corners of one path, by more than `least` [degree], near which the other turns by less than half as much.
int corners_without_counterpart(const TurningPath& one, const TurningPath& other, double window, double least) {
  const double near = 2.0 * window + 0.02;  // [em]
  int count = 0;
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    const double turn = one.turns[i];
    if (turn <= least) continue;
    bool is_peak = true;  // the first of equal ones
    for (std::size_t k = 0; k < one.points.size() && is_peak; ++k) {
      if (k == i || (one.points[k] - one.points[i]).norm() > window) continue;
      is_peak = one.turns[k] < turn || (one.turns[k] == turn && k > i);
    }
    if (!is_peak) continue;
    double counterpart = 0.0;
    for (std::size_t k = 0; k < other.points.size(); ++k) {
      if ((other.points[k] - one.points[i]).norm() <= near) counterpart = std::max(counterpart, other.turns[k]);
    }
    if (counterpart < 0.5 * turn) ++count;
  }
  return count;
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
  measures.false_corners = corners_without_counterpart(drawn, wanted, window, false_corner);
  measures.lost_corners = corners_without_counterpart(wanted, drawn, window, lost_corner);
  return measures;
}

}  // namespace calligraphy::recognition
