// Geometry of pen-downs, apart from that of the library.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

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

/// The part of a path between two lengths along it.
calligraphy::PenPath part_of(const calligraphy::PenPath& path, double from, double to);

/// So many points at equal steps along a path.
calligraphy::PenPath evenly(const calligraphy::PenPath& path, int count);

/// Where two paths cross: lengths along each of them.
struct Crossing {
  double one, other;
};

std::vector<Crossing> crossings(const calligraphy::PenPath& one, const calligraphy::PenPath& other);

/// How far two paths go through each other: of each crossing the shortest of its four tails, of these the longest; 0 if
/// they do not cross.
double depth(const calligraphy::PenPath& one, const calligraphy::PenPath& other);

/// The point of a path that is nearest to another point.
struct Nearest {
  calligraphy::Point point;
  double distance, along;  ///< from the other point; along the path
  double side;             ///< on which the other point lies: 1 left of the path, -1 right
};

Nearest nearest(const calligraphy::Point& to, const calligraphy::PenPath& path);

/// The largest distance of a path from the straight line through its ends.
double bow(const calligraphy::PenPath& path);

/// The length along a path at which its final hook begins: at the last turn of at least 60 degrees, if at most 35 % of
/// its length and 0.2 em come after it.
std::optional<double> hook_start(const calligraphy::PenPath& path);

/// A straight line in steps of at most 1 % of the em.
calligraphy::PenPath straight_line(const calligraphy::Point& from, const calligraphy::Point& to);

}  // namespace calligraphy_test
