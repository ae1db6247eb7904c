// The paths that a pen left on the paper, and the map from what a person wrote to where it should be.
#pragma once

#include <span>
#include <vector>

#include <calligraphy/collision/placed_character.hpp>
#include <calligraphy/practice/pen_trace.hpp>
#include <calligraphy/practice/recording.hpp>

namespace calligraphy {

using PenPath = std::vector<Point>;  ///< one pen-down, at least one point [em]

/// A pen-down that is shorter leaves a point: a dot, a touch or a bounce [em].
inline constexpr double tap_length = 0.02;

double path_length(std::span<const Point> path) noexcept;

/// The pen-downs of a trace, in the square that was written in.
std::vector<PenPath> pen_paths(const PenTrace& trace);

/// The pen-downs of a recording, whatever the renderer made of them, in the square of a character: samples that were
/// not refused, from each contact to the lift. A lift of 50 ms at most is a bounce, not a hand's: voluntary motion ends
/// at 10 Hz.
std::vector<PenPath> pen_paths(const Recording& recording, const Placement& placement);

/// A map of the em square that moves and stretches along x and y, and does not turn.
struct BoxMap {
  Point scale = Point::Ones();
  Point offset = Point::Zero();  ///< [em]

  Point operator()(const Point& point) const noexcept { return scale.cwiseProduct(point) + offset; }
};

/// Brings the box round what was written onto the box round the character, each axis by itself: people fill a square
/// differently. Where either box is flat (below 15 % of the em), as that of a heng, its axis is stretched as the other
/// one is; the axes are stretched at most 1.5 times apart. Taps do not count, unless there is nothing else.
BoxMap fit_box(std::span<const PenPath> paths, const Character& character);

}  // namespace calligraphy
