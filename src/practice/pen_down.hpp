// The pen-downs of a recording: from each touch to the lift.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <calligraphy/judge/pen_trace.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/recording.hpp>

namespace calligraphy {

/// Nobody lifts a pen and lowers it again within half a period of 10 Hz [s].
inline constexpr double max_bounce = 0.05;

/// Whether the pen's position is known.
inline bool is_usable(const RecordedSample& sample) noexcept {
  return has_position(sample.status) && sample.pen_tip.allFinite() && std::isfinite(sample.time);
}

/// One pen-down on the page.
struct PenDown {
  int character = 0;             ///< index of the active character when it began
  PenStroke samples;             ///< usable samples on the paper [m, s]
  double pressed = 0.0;          ///< sum of the force out of the paper over the samples [N]
  bool finished_stroke = false;  ///< whether the session took what it wrote for a stroke, or for the end of one
  bool lifted = true;            ///< false only for the last one, if the recording ends with the pen on the paper
  std::size_t captured = 0;      ///< index of the sample with which its first stroke was captured; 0: not known
  int stroke = 0;                ///< index of that stroke
};

/// A lift of at most 50 ms is a bounce and does not end a pen-down; nor does a loss of samples for at most 100 ms,
/// unless a sample shows a lift: people take longer from one stroke to the next.
std::vector<PenDown> pen_downs(const Recording& recording);

/// The same for each character of a page: a pen-down belongs to the one in whose square it lies, or to the nearest; if
/// there are several, to the one that was active.
std::vector<std::vector<PenDown>> pen_downs_by_character(const PracticePage& page, const Recording& recording);

/// Index of the sample with which a pen-down began to write: its stroke is captured when the first stretch of it is
/// written. Before that the pen sought the start, or slid there.
std::size_t writing_begin(const PenDown& down, const PracticePage& page, const Recording& recording);

}  // namespace calligraphy
