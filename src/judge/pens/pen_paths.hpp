// The pen-downs of a character: whether they can be read, and the box that they fill.
#pragma once

#include <algorithm>
#include <span>

#include <Eigen/Geometry>

#include <calligraphy/judge/pen_path.hpp>

namespace calligraphy {

/// @throws ValueError naming the pen-down if there are more than 1000, or one is empty, not finite or more than 1e9 em
/// away
void require_paths(std::span<const PenPath> paths);

/// The box of all pen-downs, taps included; empty if there are none.
inline Eigen::AlignedBox2d box_of_all(std::span<const PenPath> paths) {
  Eigen::AlignedBox2d box;
  for (const PenPath& path : paths) {
    for (const Point& point : path) box.extend(point);
  }
  return box;
}

/// Factor for lengths that hold for writing as large as the em: below 1 for smaller writing.
inline double shortening(std::span<const PenPath> paths) {
  const Eigen::AlignedBox2d box = box_of_all(paths);
  return box.isEmpty() ? 1.0 : std::min(1.0, box.sizes().maxCoeff());
}

}  // namespace calligraphy
