#include "crossings.hpp"

#include <algorithm>
#include <cstddef>

namespace calligraphy::recognition {
namespace {

constexpr double nearest_end = 0.02;    // [em]; from the end in the source; nearer, the fitted end may be extended
constexpr double longest = 0.03;        // [em]; of an extension
constexpr double least_margin = 0.002;  // [em] beyond the crossing: more than rounding to standard precision can undo
constexpr double margin = 0.003;        // [em] beyond the crossing, of an end that is extended

double cross(const Point& a, const Point& b) { return a.x() * b.y() - a.y() * b.x(); }

/// An end of a fitted stroke that may be extended.
struct StrokeEnd {
  bool at_start;
  Point tip;
  Point outwards;  ///< unit
};

/// The end of the stroke near which it crosses another in the source, at an arc length of `at`.
std::optional<StrokeEnd> end_near(double at, double source_length, const StrokeInput& stroke) {
  const std::vector<Point>& points = stroke.control_points;
  const bool at_start = at < source_length - at;
  if (std::min(at, source_length - at) > nearest_end) return std::nullopt;
  const Point& tip = at_start ? points.front() : points.back();
  const Point outwards = tip - (at_start ? points[1] : points[points.size() - 2]);
  if (outwards.norm() < 1e-6) return std::nullopt;
  return StrokeEnd{at_start, tip, outwards.normalized()};
}

/// The path with one of its ends extended as far as allowed.
Path extended(Path path, const std::optional<StrokeEnd>& end) {
  if (!end) return path;
  const Point tip = end->tip + longest * end->outwards;
  path.insert(end->at_start ? path.begin() : path.end(), tip);
  return path;
}

double from_tip(const StrokeEnd& end, double at, const Path& path) {
  return end.at_start ? at : path_length(path) - at;
}

/// True if the end, if there is one, lies farther beyond the place at arc length `at` than rounding can undo.
bool reaches_beyond(const std::optional<StrokeEnd>& end, double at, const Path& path) {
  return !end || from_tip(*end, at, path) >= least_margin;
}

/// Moves the end beyond the place at arc length `at` of the extended path. False if that is not necessary.
bool move_end(const std::optional<StrokeEnd>& end, double at, const Path& longer, StrokeInput& stroke) {
  if (!end) return false;
  const double missing = longest - from_tip(*end, at, longer);
  if (missing <= -least_margin) return false;
  (end->at_start ? stroke.control_points.front() : stroke.control_points.back()) += (missing + margin) * end->outwards;
  return true;
}

}  // namespace

std::optional<Crossing> crossing_of(std::span<const Point> one, std::span<const Point> other) {
  const Eigen::AlignedBox2d box = box_of(other);
  if (!box.intersects(box_of(one))) return std::nullopt;
  double before = 0.0;
  for (std::size_t i = 1; i < one.size(); ++i) {
    const std::span<const Point> segment = one.subspan(i - 1, 2);
    const Point along = segment[1] - segment[0];
    const Eigen::AlignedBox2d around = box_of(segment);
    if (around.intersects(box)) {
      double before_other = 0.0;
      for (std::size_t k = 1; k < other.size(); ++k) {
        const Point other_along = other[k] - other[k - 1];
        if (around.intersects(box_of(other.subspan(k - 1, 2)))) {
          const double start = cross(along, other[k - 1] - segment[0]);
          const double end = cross(along, other[k] - segment[0]);
          const double other_start = cross(other_along, segment[0] - other[k - 1]);
          const double other_end = cross(other_along, segment[1] - other[k - 1]);
          if ((start > 0.0) != (end > 0.0) && (other_start > 0.0) != (other_end > 0.0)) {
            return Crossing{before + other_start / (other_start - other_end) * along.norm(),
                            before_other + start / (start - end) * other_along.norm()};
          }
        }
        before_other += other_along.norm();
      }
    }
    before += along.norm();
  }
  return std::nullopt;
}

Path without_ends(std::span<const Point> path, double half_width) {
  constexpr int points = 60;
  if (half_width <= 0.0) return {path.begin(), path.end()};
  return resampled(path, points, half_width, path_length(path) - half_width);
}

std::vector<CrossingStrokes> crossing_strokes(std::span<const Path> paths) {
  std::vector<CrossingStrokes> found;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (const auto at = crossing_of(paths[i], paths[k])) found.push_back({i, k, *at});
    }
  }
  return found;
}

std::vector<std::size_t> keep_crossings(std::span<const CrossingStrokes> crossings, std::span<const Path> sources,
                                        std::span<StrokeInput> strokes) {
  std::vector<std::size_t> changed;
  for (const auto& [one, other, at] : crossings) {
    const Path path = flattened(strokes[one]);
    const Path other_path = flattened(strokes[other]);
    const auto end = end_near(at.on_one, path_length(sources[one]), strokes[one]);
    const auto other_end = end_near(at.on_other, path_length(sources[other]), strokes[other]);
    const auto now = crossing_of(path, other_path);
    if (now && reaches_beyond(end, now->on_one, path) && reaches_beyond(other_end, now->on_other, other_path)) continue;
    const Path longer = extended(path, end);
    const Path other_longer = extended(other_path, other_end);
    const auto meeting = crossing_of(longer, other_longer);
    if (!meeting) continue;
    if (move_end(end, meeting->on_one, longer, strokes[one])) changed.push_back(one);
    if (move_end(other_end, meeting->on_other, other_longer, strokes[other])) changed.push_back(other);
  }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  return changed;
}

}  // namespace calligraphy::recognition
