// Stroke matching: which stroke each pen-down wrote, in which order and direction, from geometry alone.
#pragma once

#include <span>
#include <vector>

#include <calligraphy/judge/character_index.hpp>
#include <calligraphy/judge/drawn_stroke.hpp>
#include <calligraphy/judge/judge_tolerances.hpp>
#include <calligraphy/judge/pen_path.hpp>
#include <calligraphy/judge/stroke_remark.hpp>
#include <calligraphy/model/character.hpp>

namespace calligraphy {

/// Result of match_strokes().
struct MatchResult {
  std::vector<DrawnStroke> drawn;     ///< one per pen-down, in the order of writing
  std::vector<StrokeRemark> remarks;  ///< of the whole, then by pen-down, then missing strokes; one for each fault
  AffineMap fit;                      ///< maps the pen-downs onto the character
  int accepted = 0;                   ///< index of the accepted form as which it was read
  Character character;                ///< that form, for remark_text()

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
