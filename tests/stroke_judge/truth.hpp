// What pen-downs wrote, which is known of them, and whether match_strokes() tells it.
#pragma once

#include <compare>
#include <string>
#include <vector>

#include <calligraphy/judge/stroke_matching.hpp>

namespace calligraphy_test {

/// What a pen-down wrote.
struct Written {
  int stroke = -1;         ///< the stroke, or the first of several, from 0; -1: none, so it is extra
  int stroke_count = 0;    ///< strokes that it wrote
  bool continues = false;  ///< it goes on with the stroke that the pen-down before it began
  bool backwards = false;  ///< from the stroke's end
  bool turned = false;     ///< as another shape: turned by a right angle
  int also = -1;           ///< a stroke that it wrote next without being the next one; -1: none
};

/// A remark that must be told: of a pen-down if it is extra, else of a stroke.
struct Due {
  calligraphy::StrokeRemarkKind kind;
  int of;  ///< from 0

  auto operator<=>(const Due&) const = default;
};

/// What each pen-down wrote, and which strokes none wrote.
struct Truth {
  std::vector<Written> written;  ///< one per pen-down
  std::vector<int> missing;      ///< strokes, from 0
  /// Strokes out of their places in the order, and those between their places and where they are: none if `last` is
  /// below `first`.
  int first_moved = 0, last_moved = -1;

  bool is_moved() const { return last_moved >= first_moved; }
  /// The remarks that must be told, in ascending order, other than of order.
  std::vector<Due> due() const;
};

/// Whether each pen-down is told to have written what it wrote, and everything that is to be remarked is, and nothing
/// else, whatever is remarked of form. Where strokes are moved, by one fault, there is one remark of order, of one that
/// is moved.
bool tells(const calligraphy::MatchResult& match, const Truth& truth);

/// Whether nothing is remarked, whatever is of form.
bool is_silent_but_form(const calligraphy::MatchResult& match);

/// Whether a remark of form is made, other than that a hook is missing, which is a note.
bool is_form_remarked(const calligraphy::MatchResult& match);

/// The character that is told to have been written in place of the one that was asked for; 0: none.
char32_t other_character(const calligraphy::MatchResult& match);

/// "1 2 4+5 4~ x, direction 2, order 1..3": the strokes of each pen-down, from 1, joined ones as 4+5, the rest of a
/// broken one as 4~, none as x; then the remarks, with the stroke or, of an extra one, the pen-down,
/// or the other character.
std::string describe(const Truth& truth);
std::string describe(const calligraphy::MatchResult& match);

}  // namespace calligraphy_test
