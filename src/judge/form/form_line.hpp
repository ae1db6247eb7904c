// A stroke as the form of a character is judged by it: a polyline of points at even steps.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// Number of points of a FormLine.
inline constexpr std::size_t form_points = 32;

/// A polyline of points at even steps along a path, ends included.
struct FormLine {
  std::array<Point, form_points> points;
  std::array<double, form_points> along;  ///< length from the start to each point [em]
  Eigen::AlignedBox2d box;

  double length() const { return along.back(); }
  Point centre() const;
  /// From the first point to the last.
  Point chord() const { return points.back() - points.front(); }
};

/// The line of a path with at least one point; each point is a mean over a step either way, which takes out tremor.
FormLine form_line(std::span<const Point> path);
/// That of given points, to which a map was applied, for example.
FormLine form_line(const std::array<Point, form_points>& points);

/// The box of several lines; empty if there are none.
Eigen::AlignedBox2d box_of_lines(std::span<const FormLine> lines);

/// Where two lines cross, as lengths along them [em].
struct Crossing {
  double on_one, on_other;
};

/// All crossings of two lines. Collinear pieces do not cross.
std::vector<Crossing> crossings(const FormLine& one, const FormLine& other);

/// The place on a line that is nearest to a point.
struct NearestPlace {
  double distance;  ///< [em]
  double along;     ///< length along the line [em]
  double side;      ///< 1 to the left of the line, -1 to its right, 0 on it
  Point point;      ///< the place
};

NearestPlace nearest_place(const Point& point, const FormLine& line);
/// The least distance of a line's points from another line [em].
double least_distance(const FormLine& line, const FormLine& other);

/// The largest distance of the points from the chord, positive if the line lies to the left of it on the whole [em].
double bow(const FormLine& line);

/// The mean distance of the points from the chord, positive to its left [em].
double mean_offset(const FormLine& line);

/// The index of the point where a final hook begins: a turn of at least 60 degrees near the end, after which at most
/// 35 % of the length follow, and at most 0.2 em.
std::optional<std::size_t> hook_of(const FormLine& line);

/// The line without its final hook; the line itself if it has none.
FormLine without_hook(const FormLine& line);

}  // namespace calligraphy
