// In which order strokes were written, against the order in which they should be.
#pragma once

#include <span>
#include <vector>

#include <calligraphy/practice/stroke_matching.hpp>

namespace calligraphy {

/// Two pen-downs, with others between them, whose strokes changed places.
struct Exchange {
  int path, other_path;
};

/// All pairs that changed places where that is all that concerns the order: what was written between them belongs
/// there.
std::vector<Exchange> find_exchanges(std::span<const DrawnStroke> drawn);

/// Sets `in_turn`. Out of turn are strokes that changed places; of the others the longest series of pen-downs whose
/// strokes rise is in turn, and of several as long the one drawn last.
void find_in_turn(std::span<DrawnStroke> drawn);

}  // namespace calligraphy
