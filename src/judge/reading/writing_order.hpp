// In which order strokes were written, against the order in which they should be.
#pragma once

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

/// What is out of order. All other pen-downs that wrote something are in turn.
struct WritingOrder {
  std::vector<Exchange> exchanges;
  std::vector<MovedStrokes> moved;
  bool is_reversed = false;  ///< from the last to the first of three strokes or more: all but the last drawn have moved

  bool has_changed_places(int path) const;
  bool has_moved(int path) const;
};

/// Strokes that changed places, and of the others those that are not in the longest series of pen-downs whose strokes
/// rise; of several such series, the one drawn last. As few pen-downs as possible are out of turn.
WritingOrder find_order(std::span<const DrawnStroke> drawn);

/// Sets `in_turn` of each by find_order().
void set_in_turn(std::span<DrawnStroke> drawn);

}  // namespace calligraphy
