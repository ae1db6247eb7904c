// The shape of a stroke, or of what a pen has written: nodes at equal arc length, and what can be told from them.
#pragma once

#include <array>
#include <cstddef>

#include <calligraphy/collision/active_stroke.hpp>

#include "written_path.hpp"

namespace calligraphy {

/// Nodes at equal arc length [em].
struct ShapeNodes {
  static constexpr std::size_t count = 32;

  std::array<double, count> x, y;

  Point at(std::size_t node) const noexcept { return {x[node], y[node]}; }
  Point chord() const noexcept { return at(count - 1) - at(0); }

  /// Distance of the farthest node from the line between the ends [em].
  double bulge() const noexcept;
  /// Length in four straight lines, at least 1e-9 [em].
  double coarse_length() const noexcept;
};

/// Nodes on a path, relative to `origin` [m, page], in a square of `em` [m].
ShapeNodes nodes_on(const WrittenPath& path, const Point& origin, double em) noexcept;

/// How much of a way [em] goes to and fro: 1 on a straight line.
inline double roughness(double way, const ShapeNodes& nodes) noexcept { return way / nodes.coarse_length(); }

/// What a stroke that is written is compared with.
struct StrokeShape {
  ShapeNodes nodes;
  Point origin = Point::Zero();  ///< its first point [m, page]
  double em = 0.0;               ///< [m]
  double length = 0.0;           ///< [em]
  double chords = 0.0;           ///< length of the way of a pen that writes it exactly, in chords [em]
  double roughness = 1.0;        ///< of that way
  double bulge = 0.0;            ///< [em]
};

/// Of a stroke in a square of `em` [m].
StrokeShape shape_of(const ActiveStroke& stroke, double em);

}  // namespace calligraphy
