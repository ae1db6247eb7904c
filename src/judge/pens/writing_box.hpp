// The box about the pen-downs of a character.
#pragma once

#include <algorithm>
#include <span>

#include <Eigen/Geometry>

#include <calligraphy/judge/pen_path.hpp>

namespace calligraphy {

/// Taps too; empty without pen-downs.
inline Eigen::AlignedBox2d box_of_all(std::span<const PenPath> paths) {
  Eigen::AlignedBox2d box;
  for (const PenPath& path : paths) {
    for (const Point& point : path) box.extend(point);
  }
  return box;
}

/// By how much lengths are to be shortened that are given for writing as large as the em: 1 if it is as large.
inline double shortening(std::span<const PenPath> paths) {
  const Eigen::AlignedBox2d box = box_of_all(paths);
  return box.isEmpty() ? 1.0 : std::min(1.0, box.sizes().maxCoeff());
}

}  // namespace calligraphy
