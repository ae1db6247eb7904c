// Fits a pen path: the typical stroke that stroke_recognition finds, its control points polished to the path.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include <Eigen/Dense>

#include <calligraphy/error.hpp>
#include <calligraphy/model/bezier.hpp>
#include <calligraphy/model/stroke_fit.hpp>
#include <calligraphy/model/typical_stroke.hpp>

#include "stroke_recognition.hpp"

namespace calligraphy {
namespace {

using recognition::Path;

constexpr double largest_coordinate = 15.0;  // [em]; validate() allows 16, and a handle may lie outside its path
constexpr double shortest_path = 0.01;       // [em]; what is shorter is a dot
constexpr double dot_length = 0.02;          // [em]
constexpr double shortest_element = 1e-4;    // [em]

/// Where each element of a stroke begins among the control points.
std::vector<std::size_t> element_starts(std::string_view elements) {
  std::vector<std::size_t> starts{0};
  for (const char kind : elements) starts.push_back(starts.back() + (kind == 'L' ? 1 : 3));
  return starts;
}

void check(std::span<const Point> median) {
  if (median.empty()) throw ValueError("a stroke needs at least one point");
  for (std::size_t i = 0; i < median.size(); ++i) {
    if (median[i].allFinite() && median[i].cwiseAbs().maxCoeff() <= largest_coordinate) continue;
    throw ValueError("point " + std::to_string(i + 1) + " of a stroke is (" + std::to_string(median[i].x()) + ", " +
                     std::to_string(median[i].y()) + "): expected finite numbers within 15 em of the origin");
  }
}

double squared_distance_to_segment(const Point& point, const Point& from, const Point& to) {
  const Point along = to - from;
  const double squared = along.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((point - from).dot(along) / squared, 0.0, 1.0) : 0.0;
  return (point - from - t * along).squaredNorm();
}

double distance_to_path(const Point& point, std::span<const Point> path) {
  double nearest = (point - path.front()).squaredNorm();
  for (std::size_t i = 1; i < path.size(); ++i) {
    nearest = std::min(nearest, squared_distance_to_segment(point, path[i - 1], path[i]));
  }
  return std::sqrt(nearest);
}

/// The stroke as a polyline: each element as `steps` pieces of equal parameter.
Path sampled(std::string_view elements, std::span<const Point> points, int line_steps, int curve_steps) {
  Path path{points.front()};
  std::size_t at = 0;
  for (const char kind : elements) {
    if (kind == 'L') {
      for (int step = 1; step <= line_steps; ++step) {
        path.push_back(points[at] + (static_cast<double>(step) / line_steps) * (points[at + 1] - points[at]));
      }
      at += 1;
    } else {
      const Bezier<3> curve{{points[at], points[at + 1], points[at + 2], points[at + 3]}};
      for (int step = 1; step <= curve_steps; ++step) {
        path.push_back(curve.point(static_cast<double>(step) / curve_steps));
      }
      at += 3;
    }
  }
  return path;
}

double largest_distance(std::span<const Point> from, std::span<const Point> to) {
  double largest = 0.0;
  for (const Point& point : from) largest = std::max(largest, distance_to_path(point, to));
  return largest;
}

/// Middle part of a limb, so that rounded corners do not turn its line.
std::span<const Point> middle(std::span<const Point> limb) {
  const std::size_t margin = limb.size() / 5;
  return limb.subspan(margin, limb.size() - 2 * margin);
}

/// Where two limbs meet when they are drawn on, or the path's own corner when they meet far away or never.
Point limb_intersection(std::span<const Point> before, std::span<const Point> after) {
  constexpr double farthest = 0.08;  // [em]
  const Point& corner = after.front();
  const recognition::Line first = recognition::line_through(middle(before));
  const recognition::Line second = recognition::line_through(middle(after));
  Eigen::Matrix2d directions;
  directions << first.direction, -second.direction;
  if (std::abs(directions.determinant()) < 0.25) return corner;
  const Point lengths = directions.inverse() * (second.through - first.through);
  const Point meeting = first.through + lengths.x() * first.direction;
  return (meeting - corner).norm() < farthest ? meeting : corner;
}

/// First guess of the control points from where the elements begin and end in the path.
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
      recognition::fit_cubic(limb, handles);
      points.insert(points.end(), handles, handles + 2);
    }
    points.push_back(vertices[element + 1]);
  }
  return points;
}

/// Puts the handle of a curve at a smooth joint on the tangent of its neighbour, which a line gives or, between two
/// curves, the one that arrives.
void make_smooth(const TypicalStroke& type, std::vector<Point>& points) {
  const std::vector<std::size_t> starts = element_starts(type.elements);
  for (std::size_t joint = 1; joint < type.elements.size(); ++joint) {
    if (type.joints[joint - 1] != 's') continue;
    const std::size_t at = starts[joint];
    const bool leaves_curve = type.elements[joint] == 'C';
    const std::size_t fixed = leaves_curve ? at - 1 : at + 1;
    const std::size_t handle = leaves_curve ? at + 1 : at - 1;
    const Point away = points[at] - points[fixed];
    const double reach = away.norm();
    if (reach < shortest_element) continue;
    const Point tangent = away / reach;
    const double along = (points[handle] - points[at]).dot(tangent);
    points[handle] = points[at] + std::max(along, 0.01) * tangent;
  }
}

/// Polishes control points by Levenberg-Marquardt on the cubes of the distances between path and stroke, both ways:
/// high powers weigh the largest distance, which is what counts, and stay differentiable.
class Polish {
 public:
  Polish(const TypicalStroke& type, const Path& path) : type_(type), path_(path) {}

  std::vector<Point> run(std::vector<Point> points, int rounds) const {
    make_smooth(type_, points);
    Eigen::VectorXd residual = residuals(points);
    double damping = 1e-2;
    for (int round = 0; round < rounds && damping < 1e4; ++round) {
      const Eigen::MatrixXd slopes = jacobian(points, residual);
      const Eigen::MatrixXd normal = slopes.transpose() * slopes;
      const Eigen::VectorXd gradient = slopes.transpose() * residual;
      const double before = residual.squaredNorm();
      bool better = false;
      while (!better && damping < 1e4) {
        Eigen::MatrixXd damped = normal;
        const double floor = 0.01 * normal.diagonal().maxCoeff() + 1e-12;
        damped.diagonal().array() += damping * (normal.diagonal().array() + floor);
        const Eigen::VectorXd step = damped.ldlt().solve(-gradient);
        std::vector<Point> moved = displaced(points, step);
        const Eigen::VectorXd next = residuals(moved);
        better = step.allFinite() && next.squaredNorm() < before;
        damping *= better ? 0.2 : 5.0;
        if (!better) continue;
        points = std::move(moved);
        residual = next;
      }
      if (!better || residual.squaredNorm() > 0.999 * before) break;
    }
    return points;
  }

 private:
  /// Distances are counted in hundredths of the em before they are cubed.
  static double weighed(double distance) { return std::pow(100.0 * distance, 3); }

  Eigen::VectorXd residuals(std::span<const Point> points) const {
    const Path coarse = sampled(type_.elements, points, 1, 14);
    const Path checked = sampled(type_.elements, points, 8, 14);
    Eigen::VectorXd values(static_cast<Eigen::Index>(path_.size() + checked.size()));
    Eigen::Index row = 0;
    for (const Point& point : path_) values[row++] = weighed(distance_to_path(point, coarse));
    for (const Point& point : checked) values[row++] = weighed(distance_to_path(point, path_));
    return values;
  }

  std::vector<Point> displaced(std::vector<Point> points, const Eigen::VectorXd& step) const {
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i] += step.segment<2>(static_cast<Eigen::Index>(2 * i));
    }
    make_smooth(type_, points);
    return points;
  }

  Eigen::MatrixXd jacobian(const std::vector<Point>& points, const Eigen::VectorXd& residual) const {
    constexpr double width = 1e-4;  // [em]
    const auto variables = static_cast<Eigen::Index>(2 * points.size());
    Eigen::MatrixXd slopes(residual.size(), variables);
    for (Eigen::Index variable = 0; variable < variables; ++variable) {
      Eigen::VectorXd step = Eigen::VectorXd::Zero(variables);
      step[variable] = width;
      slopes.col(variable) = (residuals(displaced(points, step)) - residual) / width;
    }
    return slopes;
  }

  const TypicalStroke& type_;
  const Path& path_;
};

/// Can make_character take it? Elements without length and far handles come from inputs that nobody wrote.
bool usable(const TypicalStroke& type, std::span<const Point> points) {
  for (const Point& point : points) {
    if (!point.allFinite() || point.cwiseAbs().maxCoeff() > largest_coordinate) return false;
  }
  const std::vector<std::size_t> starts = element_starts(type.elements);
  for (std::size_t element = 0; element + 1 < starts.size(); ++element) {
    if ((points[starts[element + 1]] - points[starts[element]]).norm() < shortest_element) return false;
  }
  return true;
}

/// Largest distance both ways, on samples so dense that what lies between them does not count.
double two_sided_error(const Path& path, const TypicalStroke& type, std::span<const Point> points) {
  constexpr double step = 0.004;  // [em]
  const Path stroke = sampled(type.elements, points, 1, 64);
  const Path dense_stroke = sampled(type.elements, points, 64, 64);
  Path dense_path{path.front()};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const int pieces = std::clamp(static_cast<int>((path[i] - path[i - 1]).norm() / step), 1, 64);
    for (int piece = 1; piece <= pieces; ++piece) {
      dense_path.push_back(path[i - 1] + (static_cast<double>(piece) / pieces) * (path[i] - path[i - 1]));
    }
  }
  return std::max(largest_distance(dense_path, stroke), largest_distance(dense_stroke, path));
}

/// A dot of the brush around a point: a short dian towards the lower right.
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
  return {{8, points}, two_sided_error(path, typical_stroke(8), points)};
}

/// Vertices where an element may end: those of the path and, on long pieces, points between.
std::vector<std::size_t> corners_of(const Path& vertices, const Path& refined) {
  constexpr double longest_gap = 0.10;  // [em]
  std::vector<std::size_t> corners{0};
  std::size_t vertex = 1;
  double travelled = 0.0;
  for (std::size_t i = 1; i < refined.size(); ++i) {
    travelled += (refined[i] - refined[i - 1]).norm();
    const bool at_vertex = vertex < vertices.size() && refined[i] == vertices[vertex];
    if (!at_vertex && (travelled < longest_gap || corners.size() > 24)) continue;
    if (at_vertex) ++vertex;
    corners.push_back(i);
    travelled = 0.0;
  }
  if (corners.back() + 1 != refined.size()) corners.push_back(refined.size() - 1);
  return corners;
}

}  // namespace

FittedStroke fit_stroke(std::span<const Point> median, const StrokeFitOptions&) {
  check(median);
  const recognition::CleanPath clean = recognition::clean_median(median);
  if (recognition::path_length(clean.points) < shortest_path) return dot_around(clean.points);

  constexpr std::size_t most_vertices = 20;
  const Path vertices = recognition::simplified(clean.points, most_vertices);
  const Path path = recognition::refined(vertices, 0.012);
  const recognition::Recognition found = recognition::recognise(path, corners_of(vertices, path), clean.had_entry);
  const TypicalStroke& type = typical_stroke(found.id);
  std::vector<Point> points = Polish(type, path).run(initial_points(type, path, found.splits), 25);
  if (!usable(type, points)) {
    // A straight dian is always a stroke.
    Point end = path.back();
    if ((end - path.front()).norm() < shortest_path) end = path.front() + dot_length * Point(1.0, -1.0).normalized();
    return {{8, {path.front(), end}}, two_sided_error(clean.points, typical_stroke(8), std::array{path.front(), end})};
  }
  return {{found.id, points}, two_sided_error(clean.points, type, points)};
}

}  // namespace calligraphy
