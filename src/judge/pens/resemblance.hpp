// How much a pen's path resembles a stroke, point by point in the order in which both are drawn.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <calligraphy/model/placed_character.hpp>

namespace calligraphy {

/// The cross product of two vectors: positive if the second points to the left of the first.
inline double cross(const Point& one, const Point& other) { return one.x() * other.y() - one.y() * other.x(); }

/// Two or more points at even steps over the first `length` of a path, ends included. The path has at least one point,
/// where all of them lie if it has no length.
std::vector<Point> points_along(std::span<const Point> path, double length, std::size_t count);

/// The ends of a path and those of its points that are at least this far from the last one kept: a resting pen draws
/// nothing, although its sensor never rests.
std::vector<Point> without_jitter(std::span<const Point> path, double spacing);

/// The appearance of a path: one row for each of equally long pieces, the mean of its points. A mean removes the tremor
/// of the hand; what it cuts from the ends of a path it also cuts from those of a stroke.
using Outline = Eigen::Matrix<double, 16, 2>;

/// The outline of the first `length` of a path, or of all of it.
Outline outline(std::span<const Point> path, double length);
Outline outline(std::span<const Point> path);

/// The length of an outline, shorter than that of a path with corners.
double length_of(const Outline& outline);

/// The point halfway along a path.
Point halfway(std::span<const Point> path);

/// The outline drawn the other way.
Outline reversed(const Outline& outline);

/// The outline about its own centre, with norm 1; zero for a point.
Outline centred(const Outline& outline);

/// The middle line of a stroke as a polyline fine enough for outlines.
std::vector<Point> middle_line(const Stroke& stroke, const Placement& placement = {Point::Zero(), 1.0});
/// Those of all strokes of a character, in em coordinates.
std::vector<std::vector<Point>> middle_lines(const Character& character);

/// Mean distance between the corresponding pieces of two outlines.
double mean_distance(const Outline& one, const Outline& other);

/// Whether two centred() outlines go the same way: the correlation of their points. 1 for the same shape, -1 for the
/// opposite direction, the cosine of the angle between straight lines, 0 if either is a point. It computes no
/// differences between neighbours, so tremor hardly counts.
double accord(const Outline& one, const Outline& other);

}  // namespace calligraphy
