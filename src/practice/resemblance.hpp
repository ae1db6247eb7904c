// How much a pen's path resembles a stroke, point by point in the order in which both are drawn.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <calligraphy/collision/placed_character.hpp>

namespace calligraphy {

/// Sets two or more points at even steps of the first `length` of a path, its ends included. A path has at least one
/// point; one without length stays there.
void points_along(std::span<const Point> path, double length, std::span<Point> points);
/// `count` such points.
std::vector<Point> points_along(std::span<const Point> path, double length, std::size_t count);

/// The points of a path that are at least this far from the last one kept, and its ends: a pen that rests does not draw
/// on, although its sensor never rests.
std::vector<Point> without_jitter(std::span<const Point> path, double spacing);

/// Spacing of the points of a pen-down from which it is read [em].
inline constexpr double pen_spacing = 0.005;

/// Points of a path at even steps of its length, the ends included.
using Outline = std::array<Point, 32>;

/// Of the first `length` of a path, or of all of it, by points_along().
Outline outline(std::span<const Point> path, double length);
Outline outline(std::span<const Point> path);

Outline reversed(const Outline& outline);

/// The middle line of a stroke as a polyline fine enough for outlines.
std::vector<Point> middle_line(const Stroke& stroke, const Placement& placement);

/// Mean distance of points that are as far along.
double mean_distance(const Outline& one, const Outline& other);

/// Whether they go the same way, wherever they are: 1 for the same shape, -1 for the opposite direction, about the
/// cosine of the angle between straight lines; 0 where one of them is a point.
double accord(const Outline& one, const Outline& other);

}  // namespace calligraphy
