// The ink of a stroke: how wide the brush is along it.
#pragma once

#include <array>
#include <cstddef>

namespace calligraphy {

/// Number of knots of a width profile.
inline constexpr std::size_t ink_knot_count = 8;

/// Maximum of every length in a profile [em].
inline constexpr double max_ink_length = 1.0;

/// The ink that a brush leaves along a stroke: a disc at every point of a centre line. The line is the stroke's path,
/// extended straight at both ends and shifted sideways, since heads and presses lie beside the path of the pen.
/// Half-widths and offsets are given at the knots (ink_knots()) and linear in arc length between them. Wang 2006, sec.
/// 3.2 gives all strokes one constant width.
struct StrokeInk {
  double start = 0.0;                                ///< extension of the path before its start [em]
  double end = 0.0;                                  ///< extension of the path beyond its end [em]
  std::array<double, ink_knot_count> half_widths{};  ///< radius of the disc at each knot [em]
  std::array<double, ink_knot_count>
      offsets{};  ///< shift of the centre line at each knot, to the left in writing direction [em]

  /// Whether all lengths are equal.
  bool operator==(const StrokeInk&) const = default;
};

/// Positions of the knots along an extended path of this length [em], as fractions of it from 0 to 1: two near each
/// end, at 0.035 and 0.08 em, where a brush is set down and lifted, and the others evenly in between. On a path shorter
/// than 0.28 em all are evenly spaced, or nearly so.
std::array<double, ink_knot_count> ink_knots(double length) noexcept;

}  // namespace calligraphy
