// Removal of what a brush adds to the median of a stroke, for its recognition; private to the importers.
#pragma once

#include <span>

#include "polyline.hpp"

namespace calligraphy::recognition {

/// A pen path without repeated points, brush entry and end droop [em].
struct CleanPath {
  Path points;             ///< at most 512
  bool had_entry = false;  ///< a slanted start was removed
  double first = 0.0;      ///< direction of the first 0.04 em, entry included [degree]
  double last = 0.0;       ///< direction of the last 0.04 em, droop included [degree]
};

/// Removes the slanted start and the end droop of a median. Keeps at least half of the path. O(points).
CleanPath clean_median(std::span<const Point> median);

/// The path of a pen, from which only repeated points are removed. O(points).
CleanPath clean_pen_path(std::span<const Point> path);

}  // namespace calligraphy::recognition
