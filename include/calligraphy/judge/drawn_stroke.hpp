// What a pen-down wrote.
#pragma once

namespace calligraphy {

/// Direction of a pen-down along what it wrote.
enum class WritingDirection {
  forwards,   ///< as the stroke is to be written
  backwards,  ///< from its end to its start
  neither,    ///< another shape was drawn, or only a part of the stroke
  unknown     ///< a tap has no direction
};

/// "forwards", "backwards", "neither", "unknown".
const char* to_string(WritingDirection direction) noexcept;

/// One pen-down.
struct DrawnStroke {
  int stroke = -1;         ///< the stroke it wrote, or the first of several, from 0; -1: none
  int stroke_count = 0;    ///< number of strokes it wrote; above 1: joined, as in connected writing
  bool continues = false;  ///< it continues the stroke that the previous pen-down began
  bool in_turn = true;     ///< written in order, as far as the order can be determined
  bool tap = false;        ///< shorter than tap_length
  int attempt = -1;        ///< the stroke that it resembles if it wrote none; -1: no stroke
  WritingDirection direction = WritingDirection::unknown;  ///< direction along what it wrote or attempted
  double length = 0.0;    ///< length over that of what it wrote, once both are aligned [1]
  double distance = 0.0;  ///< mean distance from what it wrote, once both are aligned [em]
  double evidence = 0.0;  ///< evidence that its direction or shape is wrong (StrokeRemark::evidence) [1]
  int also = -1;          ///< the stroke to which it went on, joined though it is not the next one; -1: none
};

}  // namespace calligraphy
