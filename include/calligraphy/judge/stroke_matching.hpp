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
  std::vector<StrokeRemark> remarks;  ///< on the whole, by pen-down, on missing strokes, then on form; one per fault
  AffineMap fit;                      ///< maps the pen-downs onto the character
  int accepted = 0;                   ///< index of the accepted form that it was read as
  Character character;                ///< that form, for remark_text()

  /// Number of remarks of a kind.
  int count(StrokeRemarkKind kind) const noexcept;
};

/// Matches pen-downs with strokes at the minimum total cost. The pen-downs are first aligned with the character as a
/// whole: an error of position or size, a slant or a turn of up to some 30 degrees is not a mistake. The cost of a pair
/// is then the mean distance between points at equal shares of the two lengths, forwards or backwards, plus a penalty
/// for the angle between them. A pen-down that resembles no stroke is extra; a stroke that no pen-down resembles is
/// missing; a pen-down that resembles several consecutive strokes, or two others, has joined them; two or three
/// pen-downs in a row that resemble one stroke together have broken it. An order other than the standard one is
/// believed only where it fits better by twice the mean cost of this hand, or by a factor of 2; a stroke runs forwards
/// within 60 degrees. Then form is judged: how the strokes meet, cross and lie beside each other, their bends and
/// places, and before that whether the writing can be read at all, is mirrored or turned. For the steps and the bounds,
/// and how often they are right, see docs/practice.md.
/// O(readings paths strokes).
///
/// `tolerances.evidence` selects which remarks are made: those of JudgeTolerances::strict() include those of normal(),
/// which include those of lenient().
///
/// `paths` are in the square of the character; writing from elsewhere is mapped there by fit_box. With `others`, there
/// is a remark if the writing is another character with as many strokes; one with fewer or more is not recognised.
/// @throws ValueError when the character or a tolerance is invalid, there are more than 1000 paths, or one is empty,
/// not finite or more than 1e9 em away
MatchResult match_strokes(const Character& character, std::span<const PenPath> paths,
                          const JudgeTolerances& tolerances = {}, const CharacterIndex* others = nullptr);

/// The same with several accepted stroke orders or forms of one character, as from CharacterSet::forms(): of those that
/// fit about equally well, the one with the fewest remarks is chosen. The price of a form is the cost of its reading
/// plus, for each stroke or block out of order, twice the mean cost of this hand or 3 % of the em, whichever is more;
/// forms up to 1.25 times the least price fit about equally well, and up to 1.75 times those of as many strokes as
/// there are pen-downs that leave nothing to remark of these. Of forms with as many remarks, fewer of form decide.
/// @throws ValueError also when there is no form, or they belong to different characters
MatchResult match_strokes(std::span<const Character> accepted, std::span<const PenPath> paths,
                          const JudgeTolerances& tolerances = {}, const CharacterIndex* others = nullptr);

}  // namespace calligraphy
