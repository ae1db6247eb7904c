// Polylines of pen paths: length, direction, simplification and refinement; private to the importers.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <calligraphy/model/character.hpp>
#include <calligraphy/model/point.hpp>

namespace calligraphy::recognition {

using Path = std::vector<Point>;

/// Direction of a vector [degree], counter-clockwise from the right: heng is about 5, shu -90, pie -125.
double direction_of(const Point& vector);

/// Angle wrapped to [-180, 180] degrees.
double wrapped(double degrees);

/// Length of a path [em].
double path_length(std::span<const Point> path);

/// Bounding box of the points.
Eigen::AlignedBox2d box_of(std::span<const Point> points);

/// `count` points, at least 2, evenly spaced along the path from arc length `from` to `to` [em].
Path resampled(std::span<const Point> path, int count, double from, double to);

/// The whole path with a point every `step` [em] or less, in at most `most` points.
Path resampled(std::span<const Point> path, double step, int most);

/// Nearest point on the segment.
Point nearest_on_segment(const Point& point, const Point& from, const Point& to);

/// Point of the path at an arc length [em] after vertex `from`, at most the last point.
Point point_after(std::span<const Point> path, std::size_t from, double length);

/// Point of the path at an arc length [em] before vertex `from`, at least the first point.
Point point_before(std::span<const Point> path, std::size_t from, double length);

/// The path without points that repeat the previous one.
Path without_repeats(std::span<const Point> points);

/// The path with fewer vertices, at most `most`, such that each dropped point is within `tolerance` [em] of the new
/// path if that limit permits (Douglas and Peucker 1973). O(points * most).
Path simplified(const Path& path, std::size_t most, double tolerance);

/// The path with vertices added so that no step exceeds `step` [em], which is increased if there would be too many.
Path refined(const Path& path, double step);

/// A stroke before it is part of a character, valid as long as `stroke`.
Stroke view_of(const StrokeInput& stroke);

/// The path of a stroke as stroke_polyline() flattens it, before it is part of a character.
Path flattened(const StrokeInput& stroke);

}  // namespace calligraphy::recognition
