// Strokes of one to five elements, and pens that move over them, along and across, smoothly and in jumps.
#pragma once

#include <span>
#include <vector>

#include "hostile_curves.hpp"

namespace calligraphy_test {

/// A stroke and a pen path over it.
struct PenPath {
  std::vector<std::vector<Point>> elements;  ///< control points of each
  std::vector<Point> ticks;                  ///< positions of the pen
};

struct PathFamily {
  const char* name;
  PenPath (*draw)(RandomPoints&);
};

std::span<const PathFamily> path_families();

/// Infinite, NaN, or so far that squares overflow.
Point draw_lost_query(RandomPoints& random);

}  // namespace calligraphy_test
