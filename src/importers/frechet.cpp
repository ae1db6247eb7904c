#include "frechet.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "stroke_polyline.hpp"

namespace calligraphy::recognition {

double frechet_distance(std::span<const Point> path, std::span<const Point> source, double free, double step) {
  constexpr int most_points = 1200;
  const Path rows = resampled(path, step, most_points);
  const Path columns = resampled(source, step, most_points);
  const std::size_t count = columns.size();
  const double column_step = path_length(source) / static_cast<double>(count - 1);
  const auto free_columns = std::min(count - 1, static_cast<std::size_t>(free / std::max(column_step, 1e-12)));
  // least[j]: squared leash of the best walk to the present row and column j.
  std::vector<double> least(count);
  for (std::size_t j = 0; j < count; ++j) {
    const double distance = (rows[0] - columns[j]).squaredNorm();
    least[j] = j <= free_columns ? distance : std::max(distance, least[j - 1]);
  }
  for (std::size_t i = 1; i < rows.size(); ++i) {
    double diagonal = least[0];
    least[0] = std::max((rows[i] - columns[0]).squaredNorm(), least[0]);
    for (std::size_t j = 1; j < count; ++j) {
      const double before = std::min({diagonal, least[j], least[j - 1]});
      diagonal = least[j];
      least[j] = std::max((rows[i] - columns[j]).squaredNorm(), before);
    }
  }
  return std::sqrt(*std::min_element(least.end() - 1 - static_cast<std::ptrdiff_t>(free_columns), least.end()));
}

double fit_error(const StrokeInput& stroke, std::span<const Point> source, double half_width) {
  constexpr double step = 0.004;  // [em]
  return frechet_distance(flattened(stroke), source, half_width, step);
}

}  // namespace calligraphy::recognition
