// The ink of a stroke: how wide the brush is along it.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace calligraphy {

struct TypicalStroke;

/// Maximum number of knots of a width profile.
inline constexpr std::size_t max_ink_knots = 24;

/// Maximum number of these that lie on corners.
inline constexpr std::size_t max_ink_corners = 4;

/// Maximum of every length in a profile [em].
inline constexpr double max_ink_length = 1.0;

/// The ink that a brush leaves along a stroke: a disc at every point of a centre line. The line is the stroke's path,
/// extended straight at both ends and shifted, since heads and presses lie beside the path of the pen. Half-widths and
/// offsets are given at the knots (ink_line()), as many as ink_size() says, and are linear in arc length between them.
/// Wang 2006, sec. 3.2 gives all strokes one constant width.
struct StrokeInk {
  double start = 0.0;                            ///< extension of the path before its start [em]
  double end = 0.0;                              ///< extension of the path beyond its end [em]
  std::array<double, max_ink_corners> shifts{};  ///< of the centre line at each corner, forward [em]; 0 after the last
  std::array<double, max_ink_knots> half_widths{};  ///< of the brush at each knot [em]; 0 after the last
  std::array<double, max_ink_knots>
      offsets{};  ///< shift of the centre line at each knot, to the left in writing direction [em]; 0 after the last

  /// Whether all lengths are equal.
  bool operator==(const StrokeInk&) const = default;
};

/// Size of a width profile.
struct InkSize {
  std::size_t knots;    ///< at which half-widths and offsets are given
  std::size_t corners;  ///< of these, on corners, where a shift is given too
};

/// Of strokes of this type with these elements: 8 knots, and more at every corner.
InkSize ink_size(const TypicalStroke& type, std::string_view elements) noexcept;

}  // namespace calligraphy
