// How far a pen got along a line, in order: the part of the line that its path follows.
#pragma once

#include <span>
#include <vector>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// Where a path lies along a line.
struct Alignment {
  double begin = 0.0, end = 0.0;  ///< the part of the line that the path follows, from one share of it to another [1]
  std::vector<double> places;     ///< place of each point of the path, as a share of the line, never decreasing [1]
};

/// Aligns a whole path with the part of a line that it follows at the least mean distance, in order: subsequence
/// dynamic time warping (Müller, Information Retrieval for Music and Motion, 2007, sec. 4.4) of points at even steps. A
/// displaced or slanted path must not count as a shorter one: until it reaches both ends of the line, it is turned and
/// moved onto the line, or, if it reaches one end, moved so that its own end is there, and aligned again. It is turned
/// by at most 20 degrees. The line has at least two points, and the path at least one.
Alignment align(std::span<const Point> path, std::span<const Point> line);

}  // namespace calligraphy
