// Remarks on a character that somebody wrote. remark_text() puts them into words.
#pragma once

#include <limits>

#include <calligraphy/judge/drawn_stroke.hpp>
#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// Kind of a remark on a stroke or a pen-down.
enum class StrokeRemarkKind {
  order,      ///< a stroke, or several in a row, out of order; or two that changed places
  direction,  ///< a stroke written backwards
  shape,      ///< a stroke drawn as another shape, or only a part of one, so that its direction is undetermined
  joined,     ///< strokes written without lifting the pen: connected writing, not a mistake of order
  broken,     ///< a stroke written in two pen-downs
  missing,    ///< a stroke that was not written
  extra,      ///< a pen-down that matches no stroke of the character
  character,  ///< the writing is another character: then this is the only remark
  lookalike   ///< a note: the writing is nearer to a character that hardly differs from this one
};

/// "order", "direction", "shape", "joined", "broken", "missing", "extra", "character", "lookalike".
const char* to_string(StrokeRemarkKind kind) noexcept;

/// A remark: one fault, or several that are reported as one.
struct StrokeRemark {
  StrokeRemarkKind kind = StrokeRemarkKind::order;  ///< kind of the fault
  int path = -1;                                    ///< the pen-down, or the first of several, from 0; -1: none
  int path_count = 0;                               ///< number of pen-downs in a row
  int stroke = -1;        ///< the stroke of the character, or the first of several, from 0; -1: none
  int stroke_count = 0;   ///< number of strokes in a row
  int other_path = -1;    ///< the pen-down whose stroke changed places with this one, or that wrote what this attempts
  int other_stroke = -1;  ///< the stroke that was due, or written before; for an extra pen-down, the one it attempts
  char32_t other_character = 0;  ///< the character that the writing is nearer to; 0: none
  Point place = Point::Zero();   ///< where to point: on the writing, or where a missing stroke belongs beside it [em]
  /// How sure or how grave it is: from 1 on JudgeTolerances::normal() includes it; infinite: always included [1].
  double evidence = std::numeric_limits<double>::infinity();
  double length = std::numeric_limits<double>::quiet_NaN();  ///< DrawnStroke::length; NaN where it does not matter [1]
  WritingDirection direction = WritingDirection::unknown;    ///< DrawnStroke::direction, where it matters
};

}  // namespace calligraphy
