#include "frechet.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace calligraphy::recognition {
namespace {

constexpr double unreachable = std::numeric_limits<double>::infinity();

double squared_distance(const Point& a, const Point& b) { return (a - b).squaredNorm(); }

/// Squared leash of a walk that always takes the step to the nearer points: at least that of the best walk.
double greedy_leash(const Path& rows, const Path& columns) {
  std::size_t i = 0;
  std::size_t j = 0;
  double leash = squared_distance(rows[0], columns[0]);
  while (i + 1 < rows.size() || j + 1 < columns.size()) {
    const bool can_go_down = i + 1 < rows.size();
    const bool can_go_right = j + 1 < columns.size();
    const double down = can_go_down ? squared_distance(rows[i + 1], columns[j]) : unreachable;
    const double right = can_go_right ? squared_distance(rows[i], columns[j + 1]) : unreachable;
    const double both = can_go_down && can_go_right ? squared_distance(rows[i + 1], columns[j + 1]) : unreachable;
    const double least = std::min({down, right, both});
    if (down == least || both == least) ++i;
    if (right == least || both == least) ++j;
    leash = std::max(leash, least);
  }
  return leash;
}

}  // namespace

double frechet_distance(std::span<const Point> path, std::span<const Point> source, double free, double step) {
  constexpr int most_points = 1200;
  const Path rows = resampled(path, step, most_points);
  const Path columns = resampled(source, step, most_points);
  const std::size_t count = columns.size();
  const double column_step = path_length(source) / static_cast<double>(count - 1);
  const auto free_columns = std::min(count - 1, static_cast<std::size_t>(free / std::max(column_step, 1e-12)));
  // The best walk passes no pair of points farther apart than the leash of any other walk.
  const double most = greedy_leash(rows, columns);
  // least[j]: squared leash of the best walk to the current row and column j; first to last: columns that are reached.
  std::vector<double> least(count, unreachable);
  std::size_t first = 0;
  std::size_t last = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t from = first;
    const std::size_t to = i == 0 ? free_columns : last;
    double diagonal = unreachable;
    double left = unreachable;
    first = count;
    for (std::size_t j = from; j < count && (j <= to + 1 || left < unreachable); ++j) {
      const double before = i == 0 && j <= free_columns ? 0.0 : std::min({diagonal, least[j], left});
      const double distance = squared_distance(rows[i], columns[j]);
      diagonal = least[j];
      left = distance <= most ? std::max(distance, before) : unreachable;
      least[j] = left;
      if (left == unreachable) continue;
      first = std::min(first, j);
      last = j;
    }
  }
  return std::sqrt(*std::min_element(least.end() - 1 - static_cast<std::ptrdiff_t>(free_columns), least.end()));
}

double fit_error(const StrokeInput& stroke, std::span<const Point> source, double half_width) {
  constexpr double step = 0.004;  // [em]
  return frechet_distance(flattened(stroke), source, half_width, step);
}

}  // namespace calligraphy::recognition
