// Fits a pen path: the typical stroke found by stroke_recognition, with its control points refined to follow the path.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include <Eigen/Dense>

#include <calligraphy/base/error.hpp>
#include <calligraphy/importers/stroke_fit.hpp>
#include <calligraphy/model/typical_stroke.hpp>

#include "base/require.hpp"
#include "brush.hpp"
#include "cubic_fit.hpp"
#include "path_distance.hpp"
#include "shoulder.hpp"
#include "stroke_polish.hpp"
#include "stroke_polyline.hpp"
#include "stroke_recognition.hpp"

namespace calligraphy {
namespace {

using namespace recognition;

constexpr double max_fitted_coordinate = 15.0;  // [em]; validate() allows 16, and a handle may lie outside its path
constexpr double min_path = 0.01;        // [em]; a shorter path is a dot
constexpr double dot_length = 0.02;      // [em]
constexpr double min_fitted_element = 1e-4;     // [em]

/// Where each element of a stroke begins among the control points.
std::vector<std::size_t> element_starts(std::string_view elements) {
  std::vector<std::size_t> starts{0};
  for (const char kind : elements) starts.push_back(starts.back() + (kind == 'L' ? 1 : 3));
  return starts;
}

void check(std::span<const Point> median) {
  if (median.empty()) throw ValueError("a stroke needs at least one point");
  for (std::size_t i = 0; i < median.size(); ++i) {
    if (median[i].allFinite() && median[i].cwiseAbs().maxCoeff() <= max_fitted_coordinate) continue;
    throw ValueError("point " + std::to_string(i + 1) + " of a stroke is (" + number_text(median[i].x()) + ", " +
                     number_text(median[i].y()) + "): expected finite numbers within 15 em of the origin");
  }
}

/// Middle part of a limb, so that rounded corners do not affect its direction.
std::span<const Point> middle(std::span<const Point> limb) {
  const std::size_t margin = limb.size() / 5;
  return limb.subspan(margin, limb.size() - 2 * margin);
}

/// Intersection of two extended limbs, or the corner of the path if they meet too far away or never.
Point limb_intersection(std::span<const Point> before, std::span<const Point> after) {
  constexpr double farthest = 0.08;  // [em]
  const Point& corner = after.front();
  const Line first = line_through(middle(before));
  const Line second = line_through(middle(after));
  Eigen::Matrix2d directions;
  directions << first.direction, -second.direction;
  if (std::abs(directions.determinant()) < 0.25) return corner;
  const Point lengths = directions.inverse() * (second.through - first.through);
  const Point meeting = first.through + lengths.x() * first.direction;
  return (meeting - corner).norm() < farthest ? meeting : corner;
}

/// Initial control points, from the positions where the elements begin and end in the path.
std::vector<Point> initial_points(const TypicalStroke& type, const Path& path, std::span<const std::size_t> splits) {
  const std::string_view elements = type.elements;
  const std::span<const Point> all(path);
  const auto piece = [&](std::size_t element) {
    return all.subspan(splits[element], splits[element + 1] - splits[element] + 1);
  };
  std::vector<Point> vertices{path.front()};
  for (std::size_t joint = 1; joint < elements.size(); ++joint) {
    const bool corner = elements[joint - 1] == 'L' && elements[joint] == 'L';
    vertices.push_back(corner ? limb_intersection(piece(joint - 1), piece(joint)) : path[splits[joint]]);
  }
  vertices.push_back(path.back());
  std::vector<Point> points{vertices.front()};
  for (std::size_t element = 0; element < elements.size(); ++element) {
    if (elements[element] == 'C') {
      Path limb(piece(element).begin(), piece(element).end());
      limb.front() = vertices[element];
      limb.back() = vertices[element + 1];
      Point handles[2];
      fit_cubic(limb, handles);
      points.insert(points.end(), handles, handles + 2);
    }
    points.push_back(vertices[element + 1]);
  }
  return points;
}

/// True if make_character() accepts the points. Elements of zero length and far handles result from unnatural input.
bool usable(const TypicalStroke& type, std::span<const Point> points) {
  for (const Point& point : points) {
    if (!point.allFinite() || point.cwiseAbs().maxCoeff() > max_fitted_coordinate) return false;
  }
  const std::vector<std::size_t> starts = element_starts(type.elements);
  for (std::size_t element = 0; element + 1 < starts.size(); ++element) {
    if ((points[starts[element + 1]] - points[starts[element]]).norm() < min_fitted_element) return false;
  }
  return true;
}

/// Maximum distance in both directions, to 1e-4 em.
double two_sided_error(const Path& path, const TypicalStroke& type, std::span<const Point> points) {
  constexpr double tolerance = 4e-5;  // [em], of the flattened stroke and of the distance
  return hausdorff_distance(path, flattened(type.elements, points, tolerance), tolerance);
}

/// A dot centred on a point: a short dian towards the lower right.
FittedStroke dot_around(const Path& path) {
  Point low = path.front();
  Point high = path.front();
  for (const Point& point : path) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const Point centre = 0.5 * (low + high);
  const Point half = 0.5 * dot_length * Point(1.0, -1.0).normalized();
  const std::vector<Point> points{centre - half, centre + half};
  const double error = two_sided_error(path, typical_stroke(8), points);
  return {{8, points}, error, error};
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

/// Alternative to a stroke whose elements do not follow the path closely: the same stroke, drawn rounder.
struct Rounder {
  int id;
  int instead;
  double from_error;  ///< [em]
};
constexpr Rounder rounder_strokes[] = {
    {5, 4, 0.01},     // short pie, pie
    {8, 38, 0.01},    // dian, chang dian
    {32, 30, 0.003},  // shu zhe, shu wan
};

/// The path of a pen, without what the brush adds.
Path pen_path(const CleanPath& clean, const StrokeFitOptions& options) {
  if (options.drawing_tool == DrawingTool::brush) return without_shoulders(clean.points);
  return options.drawing_tool == DrawingTool::textbook_pen ? without_entry(clean.points) : clean.points;
}

/// Fits one path as different strokes.
class Fit {
 public:
  Fit(const CleanPath& clean, const StrokeFitOptions& options)
      : clean_(clean),
        options_(options),
        vertices_(simplified(clean.points, 20, 0.002)),
        path_(refined(vertices_, step)),
        pen_(pen_path(clean, options)),
        followed_(refined(simplified(pen_, 96, 2e-4), step)) {}

  /// Fits the recognised typical stroke or, if that cannot follow the path, the next one that can. Without control
  /// points if none is usable.
  FittedStroke best() const {
    constexpr double far_off = 0.02;  // [em]
    constexpr std::size_t max_tries = 4;
    const std::vector<Recognition> found = recognised(options_.ids);
    FittedStroke best = nothing();
    for (std::size_t i = 0; i < std::min(found.size(), max_tries) && best.error > far_off; ++i) {
      keep_better(best, as(found[i]));
    }
    for (const Rounder& rounder : rounder_strokes) {
      if (rounder.id != best.stroke.id || best.error <= rounder.from_error) continue;
      const bool allowed = options_.ids.empty() ||
                           std::find(options_.ids.begin(), options_.ids.end(), rounder.instead) != options_.ids.end();
      const std::vector<Recognition> other = recognised({&rounder.instead, 1});
      if (allowed && !other.empty()) keep_better(best, as(other[0]));
      break;
    }
    return best;
  }

  /// A straight dian can always be fitted.
  FittedStroke straight() const {
    Point end = path_.back();
    if ((end - path_.front()).norm() < min_path) end = path_.front() + dot_length * Point(1.0, -1.0).normalized();
    const std::vector<Point> points{path_.front(), end};
    return measured({8, points});
  }

 private:
  static constexpr double step = 0.012;  // [em]

  static FittedStroke nothing() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {{8, {}}, infinity, infinity};
  }

  static void keep_better(FittedStroke& best, FittedStroke other) {
    if (other.error < best.error) best = std::move(other);
  }

  std::vector<Recognition> recognised(std::span<const int> ids) const {
    return recognise(path_, corners_of(vertices_, path_), clean_, options_.drawing_tool == DrawingTool::brush, ids);
  }

  FittedStroke as(const Recognition& found) const {
    const TypicalStroke& type = typical_stroke(found.id);
    std::vector<Point> points = polished(type, followed_, initial_points(type, path_, found.splits));
    if (!usable(type, points)) return nothing();
    return measured({found.id, std::move(points)});
  }

  FittedStroke measured(StrokeInput stroke) const {
    const TypicalStroke& type = typical_stroke(stroke.id);
    const double error = two_sided_error(pen_, type, stroke.control_points) + clean_.slack;
    const bool squared = options_.drawing_tool == DrawingTool::brush && pen_.size() != clean_.points.size();
    const double median_error =
        squared ? two_sided_error(clean_.points, type, stroke.control_points) + clean_.slack : error;
    return {std::move(stroke), error, median_error};
  }

  const CleanPath& clean_;
  const StrokeFitOptions& options_;
  Path vertices_;  ///< of the clean path
  Path path_;      ///< used for recognition
  Path pen_;       ///< used for measuring errors
  Path followed_;  ///< used for fitting
};

}  // namespace

FittedStroke fit_stroke(std::span<const Point> median, const StrokeFitOptions& options) {
  check(median);
  for (const int id : options.ids) typical_stroke(id);  // throws if there is none
  const CleanPath clean = options.drawing_tool == DrawingTool::brush ? clean_median(median) : clean_pen_path(median);
  if (path_length(clean.points) < min_path) return dot_around(clean.points);

  const Fit fit(clean, options);
  FittedStroke best = fit.best();
  return best.stroke.control_points.empty() ? fit.straight() : best;
}

}  // namespace calligraphy
