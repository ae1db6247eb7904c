#include <calligraphy/importers/stroke_warnings.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>

#include <calligraphy/importers/stroke_fit.hpp>
#include <calligraphy/model/bezier.hpp>

#include "base/parallel.hpp"
#include "polyline.hpp"

namespace calligraphy {
namespace {

using recognition::Path;

constexpr double overlap_distance = 0.01;                     // [em]; a printed line is wider
constexpr double outside_distance = 0.01;                     // [em]
constexpr double against = 100.0 * std::numbers::pi / 180.0;  // to the typical start [rad]
constexpr double max_dot = 0.25;    // [em]; one element as short as this may be called dian, pie, ti or shu
constexpr double min_start = 0.02;  // [em]; anything shorter has no direction
constexpr int curve_steps = 24;
constexpr double max_step = 0.02;  // [em]

/// Typical strokes that can have the same curve, so that geometry alone cannot distinguish them.
constexpr std::array<std::array<int, 5>, 14> alike = {{{1, 10},
                                                       {3, 4, 5},
                                                       {2, 3},
                                                       {8, 9, 38},
                                                       {6, 7, 38, 8},
                                                       {9, 4, 5},
                                                       {11, 17},
                                                       {12, 13},
                                                       {14, 15},
                                                       {20, 21, 22},
                                                       {23, 24},
                                                       {27, 28},
                                                       {30, 32},
                                                       {33, 34}}};

bool are_alike(int one, int other) {
  return std::any_of(alike.begin(), alike.end(), [&](const auto& group) {
    return std::find(group.begin(), group.end(), one) != group.end() &&
           std::find(group.begin(), group.end(), other) != group.end();
  });
}

/// One element of a stroke as a polyline, without its first point.
template <int Degree>
void append_curve(std::span<const Point> points, Path& path) {
  Bezier<Degree> curve;
  std::copy_n(points.begin(), Degree + 1, curve.control_points.begin());
  for (int i = 1; i <= curve_steps; ++i) path.push_back(curve.point(static_cast<double>(i) / curve_steps));
}

/// The stroke as a polyline with steps that are short relative to the thresholds.
Path sampled(const Stroke& stroke) {
  Path path{stroke.control_points.front()};
  std::size_t at = 0;
  for (const char kind : stroke.elements) {
    if (kind == static_cast<char>(ElementKind::line)) {
      const Point from = stroke.control_points[at];
      const Point along = stroke.control_points[at + 1] - from;
      const int steps = static_cast<int>(std::ceil(along.norm() / max_step)) + 1;
      for (int i = 1; i <= steps; ++i) path.push_back(from + (static_cast<double>(i) / steps) * along);
      at += 1;
    } else if (stroke.curve_degree == 3) {
      append_curve<3>(stroke.control_points.subspan(at), path);
      at += 3;
    } else {
      append_curve<4>(stroke.control_points.subspan(at), path);
      at += 4;
    }
  }
  return path;
}

/// Chord of the first element.
Point start_of(const Stroke& stroke) {
  const int end = points_added(stroke.elements.front(), stroke.curve_degree);
  return stroke.control_points[static_cast<std::size_t>(end)] - stroke.control_points.front();
}

Point typical_start(const TypicalStroke& type) {
  const auto end = static_cast<std::size_t>(points_added(type.elements.front(), 3));
  return Point(type.shape[end][0], type.shape[end][1]) - Point(type.shape[0][0], type.shape[0][1]);
}

/// True for a stroke of one short element, whose type depends on the character it is part of.
bool is_dot(const Stroke& stroke) {
  return stroke.elements.size() == 1 &&
         (stroke.control_points.back() - stroke.control_points.front()).norm() < max_dot;
}

/// The typical stroke whose shape the curve has, if it contradicts the recorded one; otherwise 0.
int other_type(const Stroke& stroke, const Path& path) {
  if (is_dot(stroke)) return 0;
  const int found = fit_stroke(path).recognised;
  return found == stroke.type->id || are_alike(found, stroke.type->id) ? 0 : found;
}

double distance_outside(const Path& path) {
  double farthest = 0.0;
  for (const Point& point : path) {
    farthest = std::max({farthest, -point.minCoeff(), point.maxCoeff() - 1.0});
  }
  return farthest;
}

double squared_distance(const Point& point, const Path& path) {
  double nearest = (point - path.front()).squaredNorm();
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point closest = recognition::nearest_on_segment(point, path[i - 1], path[i]);
    nearest = std::min(nearest, (point - closest).squaredNorm());
  }
  return nearest;
}

bool lies_on(const Path& path, const Path& other) {
  return std::all_of(path.begin(), path.end(), [&](const Point& point) {
    return squared_distance(point, other) <= overlap_distance * overlap_distance;
  });
}

std::string name_with_id(int id) {
  const TypicalStroke& type = typical_stroke(id);
  return std::to_string(id) + " (" + std::string(type.name) + " " + std::string(type.pinyin) + ")";
}

std::string percent_of_em(double length) {
  const long tenths = std::lround(1000.0 * length);
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " % of the em";
}

}  // namespace

const char* to_string(StrokeWarningKind kind) noexcept {
  switch (kind) {
    case StrokeWarningKind::type:
      return "type";
    case StrokeWarningKind::direction:
      return "direction";
    case StrokeWarningKind::overlap:
      return "overlap";
    case StrokeWarningKind::outside:
      break;
  }
  return "outside";
}

double start_direction_error(const Stroke& stroke) {
  const Point start = start_of(stroke);
  const Point typical = typical_start(*stroke.type);
  if (start.norm() < min_start || typical.norm() < min_start) return 0.0;  // a dot, a circle
  return std::acos(std::clamp(start.normalized().dot(typical.normalized()), -1.0, 1.0));
}

std::vector<StrokeWarning> stroke_warnings(const Character& character) {
  std::vector<StrokeWarning> warnings;
  std::vector<Path> paths;
  int number = 0;
  for (const Stroke& stroke : strokes(character)) {
    ++number;
    paths.push_back(sampled(stroke));
    const Path& path = paths.back();
    // A stroke written backwards has the shape of another: one warning suffices.
    if (start_direction_error(stroke) > against) {
      warnings.push_back(
          {number, StrokeWarningKind::direction, "starts against the direction of " + name_with_id(stroke.type->id)});
    } else if (const int other = other_type(stroke, path); other != 0) {
      warnings.push_back(
          {number, StrokeWarningKind::type,
           "is recorded as " + name_with_id(stroke.type->id) + " but has the shape of " + name_with_id(other)});
    }
    if (const double outside = distance_outside(path); outside > outside_distance) {
      warnings.push_back({number, StrokeWarningKind::outside, "leaves the em square by " + percent_of_em(outside)});
    }
    for (std::size_t other = 0; other + 1 < paths.size(); ++other) {
      if (!lies_on(path, paths[other]) && !lies_on(paths[other], path)) continue;
      warnings.push_back({number, StrokeWarningKind::overlap, "overlaps stroke " + std::to_string(other + 1)});
    }
  }
  return warnings;
}

std::vector<CharacterWarnings> character_warnings(std::span<const Character> characters, int threads,
                                                  const std::function<void(double)>& progress) {
  std::vector<std::vector<StrokeWarning>> warnings(characters.size());
  parallel_for(characters.size(), threads, progress,
               [&](std::size_t i) { warnings[i] = stroke_warnings(characters[i]); });
  std::vector<CharacterWarnings> found;
  for (std::size_t i = 0; i < characters.size(); ++i) {
    if (!warnings[i].empty()) found.push_back({characters[i].code, characters[i].order, std::move(warnings[i])});
  }
  return found;
}

}  // namespace calligraphy
