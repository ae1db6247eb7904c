// The paths of a pen on the paper, and the map that aligns a person's writing with a character.
#pragma once

#include <span>
#include <vector>

#include <calligraphy/judge/pen_trace.hpp>
#include <calligraphy/model/character.hpp>

namespace calligraphy {

using PenPath = std::vector<Point>;  ///< one pen-down, with at least one point [em]

/// A shorter pen-down leaves only a point: a dot, a touch or a bounce [em].
inline constexpr double tap_length = 0.02;

/// Length of a polyline, in the unit of its points; 0 for fewer than two.
double path_length(std::span<const Point> path) noexcept;

/// The pen-downs of a trace, in the coordinates of the square that the person wrote in, except those of the eraser.
std::vector<PenPath> pen_paths(const PenTrace& trace);

/// Translates the em square and scales it along x and y, without rotation.
struct BoxMap {
  Point scale = Point::Ones();   ///< factors along x and y [1]
  Point offset = Point::Zero();  ///< added afterwards [em]

  /// Maps a point [em].
  Point operator()(const Point& point) const noexcept { return scale.cwiseProduct(point) + offset; }
};

/// Turns, slants, scales and translates the em square.
struct AffineMap {
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();  ///< [1]
  Point offset = Point::Zero();                          ///< added afterwards [em]

  /// Maps a point [em].
  Point operator()(const Point& point) const noexcept { return linear * point + offset; }
};

/// Maps the bounding box of the writing onto that of the character, each axis separately: people fill a square
/// differently. If a side of either box is below 15 % of the em, or of its other side where that is shorter than the
/// em, such as the height of a heng, its axis is scaled like the other one. The two scales differ by a factor of
/// at most 1.5. Taps do not count unless there is nothing else.
BoxMap fit_box(std::span<const PenPath> paths, const Character& character);

}  // namespace calligraphy
