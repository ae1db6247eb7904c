// The strokes of a character, alone and several in a row, prepared for comparison with a pen.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <calligraphy/model/character.hpp>

#include "judge/pens/resemblance.hpp"

namespace calligraphy {

/// Strokes that one pen-down may have written, without lifting the pen.
inline constexpr std::size_t max_joined = 6;

/// What a pen draws that writes some strokes one after the other, with straight ways between them.
struct StrokeRun {
  Outline line;
  Outline shape;  ///< centred
  double length;  ///< of the strokes alone [em]
  double way;     ///< length of `line`, with the ways between them [em]
};

/// All runs of 1 to max_joined strokes of a character.
class StrokeOutlines {
 public:
  explicit StrokeOutlines(const Character& character);

  std::size_t count() const { return runs_[0].size(); }
  const StrokeRun& run(std::size_t first, std::size_t strokes) const { return runs_[strokes - 1][first]; }
  double length(std::size_t stroke) const { return runs_[0][stroke].length; }

 private:
  std::array<std::vector<StrokeRun>, max_joined> runs_;  ///< by the number of strokes and the first of them
};

}  // namespace calligraphy
