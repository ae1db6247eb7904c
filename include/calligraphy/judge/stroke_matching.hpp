// Stroke matching: which stroke each pen-down wrote, in which order and direction, from geometry alone.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include <calligraphy/judge/character_index.hpp>
#include <calligraphy/judge/judge_tolerances.hpp>
#include <calligraphy/judge/pen_path.hpp>
#include <calligraphy/model/character.hpp>

namespace calligraphy {

/// Direction of a pen-down along what it wrote.
enum class WritingDirection {
  forwards,   ///< as the stroke is to be written
  backwards,  ///< from its end to its start
  neither,    ///< it was drawn as another shape, or only a part of the stroke was
  unknown     ///< a tap has no direction
};

/// "forwards", "backwards", "neither", "unknown".
const char* to_string(WritingDirection direction) noexcept;

/// One pen-down.
struct DrawnStroke {
  int stroke = -1;         ///< the stroke it wrote, or the first of several, from 0; -1: none
  int stroke_count = 0;    ///< strokes that it wrote; above 1: joined, as in connected writing
  bool continues = false;  ///< it continues the stroke that the previous pen-down began
  bool in_turn = true;     ///< written in order, as far as the order can be determined
  bool tap = false;        ///< shorter than tap_length
  int attempt = -1;        ///< the stroke that it resembles, if it wrote none; -1: no stroke
  WritingDirection direction = WritingDirection::unknown;  ///< along what it wrote or attempted
  double length = 0.0;                                     ///< over that of what it wrote, once both are aligned [1]
  double distance = 0.0;  ///< mean distance from what it wrote, once both are aligned [em]
  double evidence = 0.0;  ///< that its direction or shape is wrong (StrokeRemark::evidence) [1]
};

/// What there is to remark on a stroke or a pen-down.
enum class StrokeRemarkKind {
  order,      ///< a stroke, or several in a row, out of order; or two that changed places
  direction,  ///< a stroke written backwards
  shape,      ///< a stroke drawn as another shape, or only a part of one, so that its direction is undetermined
  joined,     ///< strokes written without lifting the pen: connected writing, no mistake of order
  broken,     ///< a stroke written in two pen-downs
  missing,    ///< a stroke that was not written
  extra,      ///< a pen-down that matches no stroke of the character
  character,  ///< the writing is another character: then nothing else is told
  lookalike   ///< a note: the writing is nearer to a character that hardly differs from this one
};

/// "order", "direction", "shape", "joined", "broken", "missing", "extra", "character", "lookalike".
const char* to_string(StrokeRemarkKind kind) noexcept;

/// A remark: one fault, or what is told as one.
struct StrokeRemark {
  StrokeRemarkKind kind = StrokeRemarkKind::order;  ///< what there is to remark
  int path = -1;                                    ///< the pen-down, or the first of several, from 0; -1: none
  int path_count = 0;                               ///< pen-downs from there to the last of them
  int stroke = -1;        ///< the stroke of the character, or the first of several, from 0; -1: none
  int stroke_count = 0;   ///< strokes in a row
  int other_path = -1;    ///< the pen-down whose stroke changed places with this one, or that wrote what this attempts
  int other_stroke = -1;  ///< the stroke that was due, or written before; of an extra pen-down, that it attempts
  char32_t other_character = 0;  ///< that the writing is nearer to; 0: none
  Point place = Point::Zero();   ///< to point at: on what was written, or where a missing stroke belongs beside it [em]
  /// How sure or how grave it is: 1 where JudgeTolerances::normal() begins to tell it; infinite: always told [1].
  double evidence = std::numeric_limits<double>::infinity();
  std::string reason = {};     ///< what is wrong and what to do, in a sentence or two for people, in English
  std::string reason_zh = {};  ///< the same in simplified Chinese
};

/// Language of what people are told; Chinese is simplified.
enum class Language { english, chinese };

/// What a remark says in a language.
inline const std::string& reason_in(const StrokeRemark& remark, Language language) {
  return language == Language::chinese ? remark.reason_zh : remark.reason;
}

/// Result of match_strokes().
struct MatchResult {
  std::vector<DrawnStroke> drawn;     ///< one per pen-down, in the order of writing
  std::vector<StrokeRemark> remarks;  ///< of the whole, then by pen-down, then missing strokes; one for each fault
  AffineMap fit;                      ///< maps the pen-downs onto the character
  int accepted = 0;                   ///< of several forms that were accepted, the one as which it was read

  /// Number of remarks of a kind.
  int count(StrokeRemarkKind kind) const noexcept;
};

/// Matches pen-downs with strokes at the minimum total cost. The pen-downs are first laid on the character as a whole:
/// an error of position or size, a slant or a turn of up to some 30 degrees is not a mistake. The cost of a pair is
/// then the mean distance of points that are as far along, forwards or backwards, plus a penalty for the angle between
/// them. A pen-down that resembles no stroke is extra; a stroke that no pen-down resembles is missing; a pen-down that
/// resembles several consecutive strokes has joined them. An order other than the standard one is believed only where
/// it fits better by twice the mean cost of this hand, or by a factor of 2; a stroke runs forwards within 60 degrees.
/// For the steps and the bounds, and how often they are right, see docs/practice.md. O(readings paths strokes).
///
/// `tolerances.evidence` chooses what is told of this: what JudgeTolerances::strict() tells includes what normal()
/// tells, and that what lenient() does.
///
/// `paths` are in the square of the character; writing from elsewhere is mapped there by fit_box. With `others`, that
/// the writing is another character of as many strokes is told; one of fewer or more strokes is not recognised.
/// @throws ValueError when the character or a tolerance is invalid, there are more than 1000 paths, or one is empty,
/// not finite or more than 1e9 em away
MatchResult match_strokes(const Character& character, std::span<const PenPath> paths,
                          const JudgeTolerances& tolerances = {}, const CharacterIndex* others = nullptr);

/// The same with several stroke orders or forms of one character that are accepted, as CharacterSet::forms() has them:
/// of those that fit about as well, the one with the fewest remarks is taken. The price of one is the cost of the
/// reading, and for each stroke or block out of order twice the mean cost of this hand, or 3 % of the em if that is
/// more; it fits about as well up to 1.25 times the least price.
/// @throws ValueError also when there is none, or they are of different characters
MatchResult match_strokes(std::span<const Character> accepted, std::span<const PenPath> paths,
                          const JudgeTolerances& tolerances = {}, const CharacterIndex* others = nullptr);

}  // namespace calligraphy
