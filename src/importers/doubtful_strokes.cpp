#include <calligraphy/importers/doubtful_strokes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include <calligraphy/importers/stroke_fit.hpp>
#include <calligraphy/model/bezier.hpp>

#include "polyline.hpp"

namespace calligraphy {
namespace {

using recognition::Path;

constexpr double overlap_distance = 0.01;                     // [em]; a line of print is wider
constexpr double outside_distance = 0.01;                     // [em]
constexpr double against = 100.0 * std::numbers::pi / 180.0;  // of the typical start [rad]
constexpr double longest_dot = 0.25;     // [em]; one element as short as this may be called dian, pie, ti or shu
constexpr double shortest_start = 0.02;  // [em]; of what is shorter no direction is told
constexpr int curve_steps = 24;
constexpr double longest_step = 0.02;  // [em]

/// Typical strokes that one curve may be, so that geometry alone cannot say which is meant.
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

/// The stroke as a polyline with steps short against the bounds.
Path sampled(const Stroke& stroke) {
  Path path{stroke.control_points.front()};
  std::size_t at = 0;
  for (const char kind : stroke.type->elements) {
    if (kind == static_cast<char>(ElementKind::line)) {
      const Point from = stroke.control_points[at];
      const Point along = stroke.control_points[at + 1] - from;
      const int steps = static_cast<int>(std::ceil(along.norm() / longest_step)) + 1;
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
Point start_of(std::span<const Point> control_points, const TypicalStroke& type, int curve_degree) {
  return control_points[static_cast<std::size_t>(type.feature_points(curve_degree)[1])] - control_points.front();
}

Point typical_start(const TypicalStroke& type) {
  const auto end = static_cast<std::size_t>(type.feature_points()[1]);
  return Point(type.shape[end][0], type.shape[end][1]) - Point(type.shape[0][0], type.shape[0][1]);
}

/// Is the stroke one short element, whose name is a matter of what it is part of?
bool is_dot(const Stroke& stroke) {
  return stroke.type->elements.size() == 1 &&
         (stroke.control_points.back() - stroke.control_points.front()).norm() < longest_dot;
}

/// The typical stroke with whose shape the curve contradicts the one that is recorded; 0 when none does.
int other_type(const Stroke& stroke, const Path& path) {
  if (is_dot(stroke)) return 0;
  const int found = fit_stroke(path, {.drawn_with = DrawnWith::pen}).stroke.id;
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
    const Point foot = recognition::nearest_on_segment(point, path[i - 1], path[i]);
    nearest = std::min(nearest, (point - foot).squaredNorm());
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

const char* name_of(DoubtKind kind) noexcept {
  switch (kind) {
    case DoubtKind::type:
      return "type";
    case DoubtKind::direction:
      return "direction";
    case DoubtKind::overlap:
      return "overlap";
    case DoubtKind::outside:
      break;
  }
  return "outside";
}

double turn_from_typical_start(const Stroke& stroke) {
  const Point start = start_of(stroke.control_points, *stroke.type, stroke.curve_degree);
  const Point typical = typical_start(*stroke.type);
  if (start.norm() < shortest_start || typical.norm() < shortest_start) return 0.0;  // a dot, a circle
  return std::acos(std::clamp(start.normalized().dot(typical.normalized()), -1.0, 1.0));
}

std::vector<Doubt> doubtful_strokes(const Character& character) {
  std::vector<Doubt> doubts;
  std::vector<Path> paths;
  int number = 0;
  for (const Stroke& stroke : strokes(character)) {
    ++number;
    paths.push_back(sampled(stroke));
    const Path& path = paths.back();
    // A stroke written backwards has the shape of another: one doubt says it.
    if (turn_from_typical_start(stroke) > against) {
      doubts.push_back(
          {number, DoubtKind::direction, "starts against the direction of " + name_with_id(stroke.type->id)});
    } else if (const int other = other_type(stroke, path); other != 0) {
      doubts.push_back({number, DoubtKind::type,
                        "is called " + name_with_id(stroke.type->id) + " and has the shape of " + name_with_id(other)});
    }
    if (const double outside = distance_outside(path); outside > outside_distance) {
      doubts.push_back({number, DoubtKind::outside, "leaves the em square by " + percent_of_em(outside)});
    }
    for (std::size_t other = 0; other + 1 < paths.size(); ++other) {
      if (!lies_on(path, paths[other]) && !lies_on(paths[other], path)) continue;
      doubts.push_back({number, DoubtKind::overlap, "lies on stroke " + std::to_string(other + 1)});
    }
  }
  return doubts;
}

}  // namespace calligraphy
