// From a pen path to the typical stroke it is, by geometry alone; private to the model.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <calligraphy/model/point.hpp>

namespace calligraphy::recognition {

using Path = std::vector<Point>;

/// A pen path without repeated points, brush entry and end droop [em].
struct CleanPath {
  Path points;
  bool had_entry = false;  ///< a slanted start was cut off
};

/// Removes what a brush adds to a median and a pen does not write. Keeps at least half of the path. O(points).
CleanPath clean_median(std::span<const Point> median);

/// The path with fewer vertices, at most `most`, each dropped point near the new path (Douglas and Peucker 1973).
Path simplified(const Path& path, std::size_t most);

/// The path with vertices added so that no step is longer than `step`, which grows when there would be too many.
Path refined(const Path& path, double step);

double path_length(std::span<const Point> path);

/// Line through points by total least squares: a point on it and its unit direction.
struct Line {
  Point through;
  Point direction;
};
Line line_through(std::span<const Point> points);

/// What a path is recognised as: a typical stroke and where its elements begin and end in the path.
struct Recognition {
  int id;
  std::vector<std::size_t> splits;  ///< indices into the path, elements + 1 of them, the ends included
};

/// The typical stroke of a refined path. `corners` are indices of path vertices where an element may end, rising, the
/// first and last vertex included.
Recognition recognise(const Path& path, std::span<const std::size_t> corners, bool had_entry);

/// Largest distance of the points to the cubic with these end points that fits them best.
/// `handles` receives its inner control points.
double fit_cubic(std::span<const Point> points, Point handles[2]);

}  // namespace calligraphy::recognition
