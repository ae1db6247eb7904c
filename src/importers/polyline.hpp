// Polylines of pen paths: lengths, directions, simpler and denser versions; private to the model.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <calligraphy/model/point.hpp>

namespace calligraphy::recognition {

using Path = std::vector<Point>;

/// Direction of a vector [degree], counter-clockwise from the right: heng is about 5, shu -90, pie -125.
double direction_of(const Point& vector);

/// Angle brought to [-180, 180] degrees.
double wrapped(double degrees);

/// Length of a path [em].
double path_length(std::span<const Point> path);

/// Point of the segment nearest to a point.
Point nearest_on_segment(const Point& point, const Point& from, const Point& to);

/// Point of the path at an arc length [em] after vertex `from`, at most the last point.
Point point_after(std::span<const Point> path, std::size_t from, double length);

/// Point of the path at an arc length [em] before vertex `from`, at least the first point.
Point point_before(std::span<const Point> path, std::size_t from, double length);

/// The path without points that repeat the one before.
Path without_repeats(std::span<const Point> points);

/// The path with fewer vertices, at most `most`, each dropped point within `tolerance` [em] of the new path while that
/// limit allows (Douglas and Peucker 1973). O(points * most).
Path simplified(const Path& path, std::size_t most, double tolerance);

/// How far a path may be from what `simplified` made of it [em]. O(path * simple).
double distance_to_simplified(std::span<const Point> path, std::span<const Point> simple);

/// The path with vertices added so that no step is longer than `step` [em], which grows when there would be many.
Path refined(const Path& path, double step);

/// Line through points by total least squares: a point on it and its unit direction.
struct Line {
  Point through;
  Point direction;
};
Line line_through(std::span<const Point> points);

}  // namespace calligraphy::recognition
