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
  broken,     ///< a stroke written in two or three pen-downs
  missing,    ///< a stroke that was not written
  extra,      ///< a pen-down that matches no stroke of the character
  character,  ///< the writing is another character: then this is the only remark
  lookalike,  ///< a note: the writing is nearer to a character that hardly differs from this one
  // Of form: first what says that nothing else can be judged, and is then the only remark.
  unreadable,   ///< the writing cannot be read as this character
  orientation,  ///< the writing is mirrored or turned (StrokeRemark::orientation)
  several,      ///< more than one character was written
  parts,        ///< two parts of the character are in each other's place
  crossing,     ///< a stroke goes through or beyond another, which it should meet at most
  no_crossing,  ///< a stroke ends at or before another that it should go through
  gap,          ///< a stroke does not reach another that it should meet
  overlap,      ///< a stroke is too close to another beside which it should be, or lies on it
  side,         ///< a stroke is on the other side of another
  straight,     ///< a stroke lacks its bend, or all of them do
  bent,         ///< a stroke is bent that should be straight, or should be bent less
  wavy,         ///< a stroke wavers, or all of them do
  hook,         ///< a note: a stroke lacks its hook
  place,        ///< a stroke is out of place
  length,       ///< a stroke is much too long or too short beside the others
  proportion    ///< of two strokes, the other one should be the longer
};

/// "order", "direction", "shape", "joined", "broken", "missing", "extra", "character", "lookalike", "unreadable",
/// "orientation", "several", "parts", "crossing", "no crossing", "gap", "overlap", "side", "straight", "bent", "wavy",
/// "hook", "place", "length", "proportion".
const char* to_string(StrokeRemarkKind kind) noexcept;

/// Whether remarks of a kind are on form, from `unreadable` on, rather than on which strokes were written, in which
/// order and direction.
constexpr bool is_of_form(StrokeRemarkKind kind) noexcept { return kind >= StrokeRemarkKind::unreadable; }

/// How a character lies on the page.
enum class WritingOrientation {
  upright,
  mirrored,        ///< left and right exchanged
  upside_down,     ///< top and bottom exchanged, as if y pointed the other way
  half_turned,     ///< by 180 degrees
  turned_left,     ///< by 90 degrees, anticlockwise
  turned_right,    ///< by 90 degrees, clockwise
  mirrored_left,   ///< mirrored, then turned left
  mirrored_right,  ///< mirrored, then turned right
};

/// "upright", "mirrored", "upside down", "half turned", "turned left", "turned right", "mirrored left",
/// "mirrored right".
const char* to_string(WritingOrientation orientation) noexcept;

/// An end of a stroke.
enum class StrokeEnd { none, start, end };

/// "none", "start", "end".
const char* to_string(StrokeEnd end) noexcept;

/// A remark: one fault, or several that are reported as one.
struct StrokeRemark {
  StrokeRemarkKind kind = StrokeRemarkKind::order;  ///< kind of the fault
  int path = -1;                                    ///< the pen-down, or the first of several, from 0; -1: none
  int path_count = 0;                               ///< number of pen-downs in a row
  int stroke = -1;        ///< the stroke of the character, or the first of several, from 0; -1: none
  int stroke_count = 0;   ///< number of strokes in a row
  int other_path = -1;    ///< the pen-down whose stroke changed places with this one, or that wrote what this attempts
  /// The stroke that was due, or written before; for an extra pen-down, the one it attempts; of joined strokes, the
  /// second, if it is not the next one; of form, the other stroke of a relation, or the first one of the second part.
  int other_stroke = -1;
  char32_t other_character = 0;  ///< the character that the writing is nearer to; 0: none
  Point place = Point::Zero();   ///< where to point: on the writing, or where a missing stroke belongs beside it [em]
  /// How sure or how grave it is: from 1 on JudgeTolerances::normal() includes it; infinite: always included [1].
  double evidence = std::numeric_limits<double>::infinity();
  /// DrawnStroke::length; of `length`, that over the length that it should have beside the others; NaN where it does
  /// not matter [1].
  double length = std::numeric_limits<double>::quiet_NaN();
  WritingDirection direction = WritingDirection::unknown;    ///< DrawnStroke::direction, where it matters
  StrokeEnd end = StrokeEnd::none;                           ///< the end of `stroke` that crosses or does not reach
  /// By how much it is off, of form: how far a stroke goes beyond another, ends before it, or is out of place; by how
  /// much a gap between strokes is too small, or a stroke is longer than the one that should be; the bow that a stroke
  /// has or lacks; the length of its hook. NaN where that cannot be measured, as of the whole [em].
  double amount = std::numeric_limits<double>::quiet_NaN();
  /// Of a stroke out of place: from its place to where it is; of an end that crosses, does not cross or does not reach
  /// another stroke: from that stroke to the end [em].
  Point offset = Point::Zero();
  WritingOrientation orientation = WritingOrientation::upright;  ///< how the writing lies
};

}  // namespace calligraphy
