// Geometry of pen-downs, apart from that of the library.
#pragma once

#include <span>
#include <utility>

#include <Eigen/Geometry>

#include <calligraphy/judge/pen_path.hpp>

namespace calligraphy_test {

using Box = Eigen::AlignedBox2d;

/// Bounding box of some paths.
Box box_of(std::span<const calligraphy::PenPath> paths);
Box box_of(const calligraphy::PenPath& path);

/// Distance from one end of a path to the other.
double chord(const calligraphy::PenPath& path);

/// The point at a share of the length of a path.
calligraphy::Point point_at(const calligraphy::PenPath& path, double share);

/// A path cut in two at a share of its length: that point ends the first part and begins the second.
std::pair<calligraphy::PenPath, calligraphy::PenPath> cut(const calligraphy::PenPath& path, double share);

/// A straight line in steps of at most 1 % of the em.
calligraphy::PenPath straight_line(const calligraphy::Point& from, const calligraphy::Point& to);

}  // namespace calligraphy_test
