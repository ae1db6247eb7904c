// How much a pen's path resembles a stroke, point by point in the order in which both are drawn.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <calligraphy/model/placed_character.hpp>

namespace calligraphy {

/// Sets two or more points at even steps of the first `length` of a path, its ends included. A path has at least one
/// point; one without length stays there.
void points_along(std::span<const Point> path, double length, std::span<Point> points);
/// `count` such points.
std::vector<Point> points_along(std::span<const Point> path, double length, std::size_t count);

/// The points of a path that are at least this far from the last one kept, and its ends: a pen that rests does not draw
/// on, although its sensor never rests.
std::vector<Point> without_jitter(std::span<const Point> path, double spacing);

/// What a path looks like: a row for each piece of an equal share of its length, the mean of its points. A mean forgets
/// the tremor of the hand, and what it takes from the ends of a path it takes from those of a stroke too.
using Outline = Eigen::Matrix<double, 16, 2>;

/// Of the first `length` of a path, or of all of it.
Outline outline(std::span<const Point> path, double length);
Outline outline(std::span<const Point> path);

/// Its length, shorter than that of the path where this has corners.
double length_of(const Outline& outline);

/// Drawn the other way.
Outline reversed(const Outline& outline);

/// Around its own centre, with norm 1; zero of a point.
Outline centred(const Outline& outline);

/// The middle line of a stroke as a polyline fine enough for outlines.
std::vector<Point> middle_line(const Stroke& stroke, const Placement& placement);

/// Mean distance of pieces that are as far along.
double mean_distance(const Outline& one, const Outline& other);

/// Whether centred() outlines go the same way: the correlation of their points, 1 for the same shape, -1 for the
/// opposite direction, the cosine of the angle between straight lines; 0 where one of them is a point. It takes no
/// differences of neighbours, so that tremor hardly counts.
double accord(const Outline& one, const Outline& other);

}  // namespace calligraphy
