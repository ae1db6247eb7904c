// Fits typical strokes to a path: those that a label allows or that geometry alone recognises, the likeliest first,
// until one follows the path.
#include <calligraphy/importers/stroke_fit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/typical_stroke.hpp>

#include "base/require.hpp"
#include "brush.hpp"
#include "brush_stroke_fit.hpp"
#include "control_points.hpp"
#include "frechet.hpp"
#include "outline.hpp"
#include "stroke_division.hpp"
#include "stroke_recognition.hpp"

namespace calligraphy {
namespace {

using namespace recognition;

constexpr double max_fitted_coordinate = 15.0;  // [em]; validate() allows 16, and a handle may lie outside its path
constexpr double min_path = 0.01;               // [em]; a shorter path is a dot
constexpr double dot_length = 0.02;             // [em]
constexpr double min_fitted_element = 1e-4;     // [em]

void check(std::span<const Point> points, const char* what) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite() && points[i].cwiseAbs().maxCoeff() <= max_fitted_coordinate) continue;
    throw ValueError("point " + std::to_string(i + 1) + " of " + what + " is (" + number_text(points[i].x()) + ", " +
                     number_text(points[i].y()) + "): expected finite numbers within 15 em of the origin");
  }
}

/// True if make_character() accepts the points. Elements of zero length and far handles result from unnatural input.
bool usable(std::string_view elements, std::span<const Point> points) {
  for (const Point& point : points) {
    if (!point.allFinite() || point.cwiseAbs().maxCoeff() > max_fitted_coordinate) return false;
  }
  std::size_t at = 0;
  for (const char kind : elements) {
    const std::size_t end = at + (kind == 'L' ? 1 : 3);
    if ((points[end] - points[at]).norm() < min_fitted_element) return false;
    at = end;
  }
  return true;
}

/// Vertices where an element may end: those of the path and, on long pieces, intermediate points.
std::vector<std::size_t> corners_of(const Path& vertices, const Path& refined) {
  constexpr double max_gap = 0.10;  // [em]
  std::vector<std::size_t> corners{0};
  std::size_t vertex = 1;
  double travelled = 0.0;
  for (std::size_t i = 1; i < refined.size(); ++i) {
    travelled += (refined[i] - refined[i - 1]).norm();
    const bool at_vertex = vertex < vertices.size() && refined[i] == vertices[vertex];
    if (!at_vertex && (travelled < max_gap || corners.size() > 24)) continue;
    if (at_vertex) ++vertex;
    corners.push_back(i);
    travelled = 0.0;
  }
  if (corners.back() + 1 != refined.size()) corners.push_back(refined.size() - 1);
  return corners;
}

/// The typical strokes that the path may be by geometry alone, the likeliest first.
std::vector<int> recognised_ids(std::span<const Point> path, bool brush) {
  constexpr double step = 0.012;  // [em]
  const CleanPath clean = brush ? clean_median(path) : clean_pen_path(path);
  const Path vertices = simplified(clean.points, 20, 0.002);
  const Path all = refined(vertices, step);
  std::vector<int> ids;
  for (const Recognition& found : recognise(all, corners_of(vertices, all), clean, brush)) ids.push_back(found.id);
  return ids;
}

/// Alternative to a stroke that does not follow the path: the same, drawn rounder or with a hook.
struct Alternative {
  int id;
  int instead;
  double beyond = 0.0;  ///< distance from the path beyond which the stroke gives way [em]
};
constexpr Alternative alternatives[] = {
    {5, 4},                    // short pie, pie
    {8, 38},                   // dian, chang dian
    {9, 38},                   // left dian, chang dian
    {9, 4},                    // left dian, pie
    {32, 30},                  // shu zhe, shu wan
    {36, 30},                  // pie zhe, shu wan
    {16, 18, reach_of_brush},  // heng zhe, heng zhe gou
};

/// Fits one path as different strokes.
class Fit {
 public:
  struct Attempt {
    StrokeInput stroke{0, {}};
    double distance = std::numeric_limits<double>::infinity();  ///< Fréchet distance from the samples [em]
  };

  explicit Fit(std::span<const Point> path, const BrushEnds& ends)
      : path_(samples(path, ends)), divider_(path_), follows_(std::min(0.018, 0.1 * path_length(path_))) {}

  /// Among strokes that a label allows, the first that follows the path, or else the closest; among those that geometry
  /// recognises, the first, unless it misses a corner. A line that does not follow the path gives way to a curve, and a
  /// heng zhe far from it to one with a hook, if the label allows that. Has no control points if no stroke is usable.
  Attempt best(std::span<const int> ids, bool labelled) {
    constexpr std::size_t most_tries = 3;
    constexpr double bend = 0.027;  // [em]; a path this far from a stroke of one element has a corner
    const auto allows = [&](int id) { return !labelled || std::find(ids.begin(), ids.end(), id) != ids.end(); };
    const auto is_acceptable = [&](const Attempt& attempt) {
      if (labelled || attempt.stroke.id == 0) return attempt.distance <= follows_;
      return attempt.distance <= bend || typical_stroke(attempt.stroke.id).elements.size() > 1;
    };
    Attempt best;
    for (std::size_t i = 0; i < std::min(ids.size(), most_tries); ++i) {
      Attempt other = fit_as(ids[i]);
      if (other.distance < best.distance) best = std::move(other);
      if (is_acceptable(best)) break;
    }
    const int first = best.stroke.id;
    for (const auto& [id, instead, beyond] : alternatives) {
      if (id != first || !allows(instead) || best.distance <= std::max(follows_, beyond)) continue;
      Attempt other = fit_as(instead);
      if (other.distance < best.distance) best = std::move(other);
    }
    return best;
  }

  /// The strokes in ascending order of the cost of dividing the path among their elements.
  std::vector<int> by_cost(std::span<const int> ids) {
    std::vector<std::pair<double, int>> costs;
    for (const int id : ids) {
      const TypicalStroke& type = typical_stroke(id);
      costs.emplace_back(divider_.divide(type, type.elements).cost, id);
    }
    std::sort(costs.begin(), costs.end());
    std::vector<int> sorted;
    for (const auto& [cost, id] : costs) sorted.push_back(id);
    return sorted;
  }

  /// Replaces lines of the stroke by curves that bring it closer to the path: while it is more than 1.8 % of the em
  /// away, the curve that helps most, if that reduces the distance by a tenth; three at most.
  StrokeInput bent(Attempt best) {
    constexpr double far_off = 0.018;    // [em]
    constexpr double improvement = 0.9;  // [1]
    constexpr int most_curves = 3;
    for (int curves = 0; curves < most_curves && best.distance > far_off; ++curves) {
      Attempt closest{{0, {}}, improvement * best.distance};
      std::string elements(best.stroke.composition().elements());
      for (char& element : elements) {
        if (element != static_cast<char>(ElementKind::line)) continue;
        element = static_cast<char>(ElementKind::curve);
        Attempt other = fit_as(best.stroke.id, elements);
        if (other.distance < closest.distance) closest = std::move(other);
        element = static_cast<char>(ElementKind::line);
      }
      if (closest.stroke.id == 0) break;
      best = std::move(closest);
    }
    return std::move(best.stroke);
  }

  /// A straight dian can always be fitted.
  StrokeInput straight() const {
    Point end = path_.back();
    if ((end - path_.front()).norm() < min_path) end = path_.front() + dot_length * Point(1.0, -1.0).normalized();
    return {8, {path_.front(), end}};
  }

 private:
  static Path samples(std::span<const Point> path, const BrushEnds& ends) {
    constexpr double step = 0.008;  // [em]
    constexpr int fewest = 16;
    constexpr int most = 140;
    const double length = path_length(path);
    const double pieces = std::ceil(std::min((length - ends.start - ends.end) / step, static_cast<double>(most)));
    const int count = std::clamp(static_cast<int>(pieces) + 1, fewest, most);
    return resampled(path, count, ends.start, length - ends.end);
  }

  Attempt fit_as(int id, std::string_view elements) {
    constexpr double step = 0.008;  // [em]
    const TypicalStroke& type = typical_stroke(id);
    const Division division = divider_.divide(type, elements);
    if (division.ends.empty()) return {};
    std::vector<Point> points = fit_control_points(type, elements, path_, division.ends);
    if (!usable(elements, points)) return {};
    StrokeInput stroke{id, std::move(points)};
    if (elements != type.elements) stroke.elements = elements;
    const double distance = frechet_distance(flattened(stroke), path_, 0.0, step);
    return {std::move(stroke), distance};
  }

  Attempt fit_as(int id) { return fit_as(id, typical_stroke(id).elements); }

  Path path_;  ///< evenly spaced, without the ends that the tip of the brush covers
  StrokeDivider divider_;
  double follows_;  ///< distance within which a stroke follows the path: 1.8 % of the em, 10 % of a short path [em]
};

/// A dot centred on a point: a short dian towards the lower right.
StrokeInput dot_around(std::span<const Point> path) {
  const Point centre = box_of(path).center();
  const Point half = 0.5 * dot_length * Point(1.0, -1.0).normalized();
  return {8, {centre - half, centre + half}};
}

/// The strokes of `ids` in the order in which they are tried: the recognised one first, then by cost; without ids, as
/// recognised.
std::vector<int> in_order(Fit& fit, std::span<const int> ids, std::span<const int> recognised) {
  if (ids.empty()) return {recognised.begin(), recognised.end()};
  if (ids.size() == 1) return {ids.begin(), ids.end()};
  std::vector<int> order = fit.by_cost(ids);
  const auto first = std::find(order.begin(), order.end(), recognised.front());
  if (first != order.end()) std::rotate(order.begin(), first, first + 1);
  return order;
}

}  // namespace

FittedStroke recognition::fit_brush_stroke(std::span<const Point> path, const Outline& outline,
                                           std::span<const int> ids) {
  if (path.empty()) throw ValueError("a stroke needs at least one point");
  check(path, "a stroke");
  for (const int id : ids) typical_stroke(id);  // throws if there is none

  FittedStroke fitted;
  fitted.half_width = half_width(path, outline);
  if (path_length(path) < min_path) {
    fitted.stroke = dot_around(path);
    fitted.recognised = fitted.stroke.id;
    fitted.unbent_error = fit_error(fitted.stroke, path, fitted.half_width);
  } else {
    const bool brush = !outline.empty();
    const std::vector<int> recognised = recognised_ids(path, brush);
    Fit fit(path, brush_ends(path, outline, fitted.half_width));
    Fit::Attempt best = fit.best(in_order(fit, ids, recognised), !ids.empty());
    if (best.stroke.control_points.empty()) best.stroke = fit.straight();
    fitted.unbent_error = fit_error(best.stroke, path, fitted.half_width);
    fitted.stroke = fit.bent(std::move(best));
    fitted.recognised = recognised.front();
  }
  fitted.error = fit_error(fitted.stroke, path, fitted.half_width);
  return fitted;
}

FittedStroke fit_stroke(std::span<const Point> path, const StrokeFitOptions& options) {
  check(options.outline, "an outline");
  return fit_brush_stroke(path, options.outline, options.ids);
}

}  // namespace calligraphy
