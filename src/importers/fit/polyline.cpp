#include "polyline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <calligraphy/model/stroke_polyline.hpp>
#include <calligraphy/model/typical_stroke.hpp>

namespace calligraphy::recognition {

double direction_of(const Point& vector) { return std::atan2(vector.y(), vector.x()) * 180.0 / std::numbers::pi; }

double wrapped(double degrees) { return std::remainder(degrees, 360.0); }

double path_length(std::span<const Point> path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
  return length;
}

Eigen::AlignedBox2d box_of(std::span<const Point> points) {
  Eigen::AlignedBox2d box;
  for (const Point& point : points) box.extend(point);
  return box;
}

Path resampled(std::span<const Point> path, int count, double from, double to) {
  Path result;
  result.reserve(static_cast<std::size_t>(count));
  std::size_t segment = 1;  // its end
  double before = 0.0;      // arc length at its beginning
  double length = path.size() > 1 ? (path[1] - path[0]).norm() : 0.0;
  for (int i = 0; i < count; ++i) {
    const double at = from + (to - from) * i / (count - 1);
    while (segment + 1 < path.size() && before + length < at) {
      before += length;
      ++segment;
      length = (path[segment] - path[segment - 1]).norm();
    }
    if (length <= 0.0) {
      result.push_back(path[std::min(segment, path.size() - 1)]);
      continue;
    }
    const double share = std::clamp((at - before) / length, 0.0, 1.0);
    result.push_back(path[segment - 1] + share * (path[segment] - path[segment - 1]));
  }
  return result;
}

Path resampled(std::span<const Point> path, double step, int most) {
  const double length = path_length(path);
  const double pieces = std::ceil(std::min(length / step, static_cast<double>(most)));
  return resampled(path, std::clamp(static_cast<int>(pieces) + 1, 2, most), 0.0, length);
}

Point nearest_on_segment(const Point& point, const Point& from, const Point& to) {
  const Point along = to - from;
  const double squared = along.squaredNorm();
  if (squared == 0.0) return from;
  return from + std::clamp((point - from).dot(along) / squared, 0.0, 1.0) * along;
}

Point point_after(std::span<const Point> path, std::size_t from, double length) {
  for (std::size_t i = from; i + 1 < path.size(); ++i) {
    const double step = (path[i + 1] - path[i]).norm();
    if (step >= length && step > 0.0) return path[i] + (length / step) * (path[i + 1] - path[i]);
    length -= step;
  }
  return path.back();
}

Point point_before(std::span<const Point> path, std::size_t from, double length) {
  for (std::size_t i = from; i > 0; --i) {
    const double step = (path[i - 1] - path[i]).norm();
    if (step >= length && step > 0.0) return path[i] + (length / step) * (path[i - 1] - path[i]);
    length -= step;
  }
  return path.front();
}

Path without_repeats(std::span<const Point> points) {
  constexpr double nearest = 1e-9;  // [em]
  Path path;
  for (const Point& point : points) {
    if (path.empty() || (point - path.back()).norm() > nearest) path.push_back(point);
  }
  return path;
}

Path simplified(const Path& path, std::size_t most, double tolerance) {
  if (path.size() < 3) return path;
  // Adds the vertex farthest from the path so far, in at most `most` passes.
  std::vector<std::size_t> kept{0, path.size() - 1};
  std::vector<double> distance(path.size(), 0.0);
  const auto measure = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from + 1; i < to; ++i)
      distance[i] = (path[i] - nearest_on_segment(path[i], path[from], path[to])).norm();
    distance[from] = distance[to] = 0.0;
  };
  measure(0, path.size() - 1);
  while (kept.size() < most) {
    const auto farthest = std::max_element(distance.begin(), distance.end());
    if (*farthest <= tolerance) break;
    const auto index = static_cast<std::size_t>(farthest - distance.begin());
    const auto next = std::upper_bound(kept.begin(), kept.end(), index);
    const std::size_t before = *(next - 1);
    const std::size_t after = *next;
    kept.insert(next, index);
    measure(before, index);
    measure(index, after);
  }
  Path result;
  for (const std::size_t index : kept) result.push_back(path[index]);
  return result;
}

Path refined(const Path& path, double step) {
  constexpr double max_steps = 96.0;
  step = std::max(step, path_length(path) / max_steps);
  Path result{path.front()};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const int pieces = std::max(1, static_cast<int>(std::ceil((path[i] - path[i - 1]).norm() / step)));
    for (int piece = 1; piece <= pieces; ++piece) {
      result.push_back(path[i - 1] + (static_cast<double>(piece) / pieces) * (path[i] - path[i - 1]));
    }
  }
  return result;
}

Stroke view_of(const StrokeInput& stroke) {
  return {&typical_stroke(stroke.id), stroke.composition().elements(), 3, stroke.control_points, {}};
}

Path flattened(const StrokeInput& stroke) { return calligraphy::stroke_polyline(view_of(stroke)); }

}  // namespace calligraphy::recognition
