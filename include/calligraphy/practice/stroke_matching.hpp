// Which stroke each pen-down wrote, in which order and in which direction, from geometry alone.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <calligraphy/model/character.hpp>
#include <calligraphy/practice/pen_path.hpp>

namespace calligraphy {

/// How a pen-down runs along what it wrote.
enum class WritingDirection {
  forwards,
  backwards,
  neither,  ///< it was drawn as another shape
  unknown   ///< a tap runs nowhere
};

/// "forwards", "backwards", "neither", "unknown".
const char* to_string(WritingDirection direction) noexcept;

/// One pen-down.
struct DrawnStroke {
  int stroke = -1;         ///< that it wrote, or the first of those that it wrote, from 0; -1: none
  int stroke_count = 0;    ///< 1; above: joined, as connected writing does; 0: none
  bool continues = false;  ///< it goes on with the stroke that the pen-down before began
  bool in_turn = true;     ///< no stroke that comes later was written before, as far as the order can be told
  bool tap = false;        ///< it left no more than a point
  WritingDirection direction = WritingDirection::unknown;
  double distance = 0.0;  ///< mean distance from what it wrote, once both lie on each other as well as they can [em]
};

enum class StrokeRemarkKind {
  order,      ///< a stroke out of turn
  direction,  ///< a stroke written backwards
  shape,      ///< a stroke whose direction cannot be told, because it was drawn as another shape
  joined,     ///< strokes written without lifting the pen: connected writing, no mistake of order
  broken,     ///< a stroke written in two pen-downs
  missing,    ///< a stroke that was not written
  extra       ///< a pen-down that is no stroke of the character
};

/// "order", "direction", "shape", "joined", "broken", "missing", "extra".
const char* to_string(StrokeRemarkKind kind) noexcept;

struct StrokeRemark {
  StrokeRemarkKind kind;
  int path;            ///< the pen-down, from 0; -1: none
  int stroke;          ///< the stroke of the character, from 0; -1: none
  std::string reason;  ///< one sentence for a person
};

struct MatchResult {
  std::vector<DrawnStroke> drawn;     ///< one per pen-down, in the order of writing
  std::vector<StrokeRemark> remarks;  ///< by pen-down, then what is missing
  BoxMap fit;                         ///< that laid the pen-downs on the character

  int count(StrokeRemarkKind kind) const noexcept;
};

/// Matches pen-downs with strokes at the least cost in all. A pair costs the mean distance of points that are as far
/// along, forwards or backwards, and what it is turned, after the pen-downs as a whole were moved and stretched to lie
/// on the strokes as well as they can: neither a place nor a size that is off is a mistake. What resembles no stroke is
/// extra, what no pen-down resembles is missing; a pen-down that resembles strokes one after the other joined them.
/// Another order than the right one is believed where it fits better by 5 % of the em or twice as well.
/// docs/practice.md has the steps and the bounds. O(refits paths strokes).
///
/// `paths` are in the square of the character, or are brought there by fit_box when they are somewhere else.
/// @throws ValueError when the character is invalid, there are more than 1000 paths, one is empty or not finite
MatchResult match_strokes(const Character& character, std::span<const PenPath> paths);

}  // namespace calligraphy
