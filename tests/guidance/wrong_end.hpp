// Whether a stroke that is begun at its end and written backwards is resisted (Wang 2006, Fig. 4).
#pragma once

#include <functional>
#include <vector>

#include "sequence.hpp"

namespace calligraphy_test {

inline constexpr double felt_resistance = 0.2;  ///< against the motion, not counting friction and dampers [N]

/// A due stroke, drawn from its end to its start.
struct WrongEnd {
  char32_t character = 0;
  int stroke = 0;       ///< from 0
  double length = 0.0;  ///< [em]
  double most = 0.0;    ///< largest force against the motion where the resistance acts [N]
  double work = 0.0;    ///< of the force against the motion, over the whole stroke [J]
  bool taken = false;   ///< it finished a stroke
  bool resisted() const { return most >= felt_resistance && work > 0.0; }
};

/// Draws each stroke of the characters from its end to its start, as fast as people write, the strokes before it drawn
/// exactly: by a pen that is where it is meant to be, whatever the force. What opposes it is what is sent in the paper
/// plane, less friction and dampers, which oppose motion either way: all that pulls it along counts.
std::vector<WrongEnd> draw_from_wrong_end(const std::vector<calligraphy::Character>& characters,
                                          const SequenceOptions& options,
                                          const std::function<void(double)>& progress = nullptr);

/// The first characters that have so many strokes together.
std::vector<calligraphy::Character> with_strokes(const std::vector<calligraphy::Character>& characters, int strokes);

}  // namespace calligraphy_test
