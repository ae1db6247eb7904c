// The ink of a stroke: how wide the brush is along it.
#pragma once

#include <array>
#include <cstddef>

namespace calligraphy {

/// Number of knots of a width profile.
inline constexpr std::size_t ink_knot_count = 8;

/// No length of a profile exceeds this [em].
inline constexpr double max_ink_length = 1.0;

/// What a brush leaves of a stroke: a disc at every point of a centre line. The line is the stroke's path, drawn out
/// straight at both ends and moved sideways, since heads and presses lie beside the path of the pen. Half-widths and
/// offsets are those at the knots (ink_knots()), linear in arc length between them. Wang 2006, sec. 3.2 gives all
/// strokes one constant width.
struct StrokeInk {
  double start = 0.0;                                ///< by which the path is drawn out before its start [em]
  double end = 0.0;                                  ///< by which it is drawn out beyond its end [em]
  std::array<double, ink_knot_count> half_widths{};  ///< at the knots, of the disc [em]
  std::array<double, ink_knot_count>
      offsets{};  ///< at the knots, of the centre line, to the left as the stroke is written [em]

  /// Whether all lengths are equal.
  bool operator==(const StrokeInk&) const = default;
};

/// Where the knots lie along a drawn out path of this length [em], as shares of it from 0 to 1: two near each end, at
/// 0.035 and 0.08 em, where a brush is set down and lifted, and the others evenly between. On a path shorter than
/// 0.28 em all are evenly spaced, or nearly so.
std::array<double, ink_knot_count> ink_knots(double length) noexcept;

}  // namespace calligraphy
