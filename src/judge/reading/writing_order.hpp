// The order in which strokes were written, compared with the one in which they should be.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <calligraphy/judge/stroke_matching.hpp>

namespace calligraphy {

/// Two pen-downs, with others between them, whose strokes changed places.
struct Exchange {
  int path, other_path;
};

/// Pen-downs in a row that wrote strokes in a row, all out of turn.
struct MovedStrokes {
  int path, last_path;
  int stroke, stroke_count;
};

/// What is out of order. All other pen-downs that wrote strokes are in turn.
struct WritingOrder {
  std::vector<Exchange> exchanges;
  std::vector<MovedStrokes> moved;
  bool is_reversed = false;  ///< three strokes or more, from last to first: all but the one drawn last have moved

  bool has_changed_places(int path) const;
  bool has_moved(int path) const;
};

/// Finds strokes that changed places, and those of the others that are not in the longest series of pen-downs with
/// rising strokes; of several such series, the one drawn last. As few pen-downs as possible are out of turn.
WritingOrder find_order(std::span<const DrawnStroke> drawn);

/// Indices of the longest rising series of numbers, in order; of several, the one whose numbers come last.
/// O(n log n) (Fredman 1975).
std::vector<std::size_t> longest_rise(std::span<const std::size_t> numbers);

/// Sets `in_turn` of each by find_order().
void set_in_turn(std::span<DrawnStroke> drawn);

}  // namespace calligraphy
