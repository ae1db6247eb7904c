// Faults of form put into pens that wrote a character right: strokes that protrude, do not reach, lie on each other,
// are bent or straight, and writing that is turned, doubled or nothing at all.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <calligraphy/judge/stroke_remark.hpp>

#include "right_pens.hpp"

namespace calligraphy_test {

/// What is done, by `FormRow::size`. Meetings, crossings, gaps and bows must be the character's and the pen's own.
enum class FormFault {
  protrude,      ///< an end that meets another stroke in its course is prolonged straight beyond it [em]
  uncross,       ///< a crossing is cut back to a meeting: of its four tails, each at least 0.08 em, the shortest goes
  fall_short,    ///< an end that meets another stroke ends before it [em]
  collapse,      ///< of two neighbours side by side, 0.06 to 0.3 em apart, one is moved: to this share of the gap [1]
  collapse_all,  ///< three or more neighbours side by side are moved onto one place
  chords,        ///< every stroke is straight, where one has a bow of at least 0.13 em apart from its hook
  chord,         ///< one with a bow of 0.2 to 0.3 em is straight
  arch,          ///< a straight one of at least 0.4 em is an arc with this bow [em]
  zigzag,        ///< such a one is a square wave of this amplitude [em]
  waver,         ///< one of at least 0.25 em is a triangle wave of this amplitude about itself, of 0.08 to 0.2 em [em]
  waver_all,     ///< all are, where one is as long [em]
  displace,      ///< one is moved, in any direction [em]
  shrink_half,   ///< half of the strokes are of this size about their middle [1]
  drop_hook,     ///< one lacks its hook
  swap_parts,    ///< two parts, centres at least 0.2 em apart and hardly overlapping, change places, in the same order
  turn,          ///< all lies otherwise (FormRow::orientation)
  write_twice,   ///< all is written once more on the right, of 60 to 100 % of the size
  scribble       ///< as many random curves in the same box
};

/// One row of the table.
struct FormRow {
  std::string name;  ///< one word
  FormFault fault;
  double size = 0.0;
  std::vector<calligraphy::StrokeRemarkKind> kinds;  ///< any of which tells it; the first says it best
  calligraphy::WritingOrientation orientation = calligraphy::WritingOrientation::upright;

  /// Another seed gives another case.
  bool is_random() const { return fault != FormFault::turn && fault != FormFault::chords; }
};

/// All rows, in the order of the table. A row keeps its index, of which its seeds are made.
const std::vector<FormRow>& form_rows();
/// @throws ValueError for an unknown name
const FormRow& form_row_named(const std::string& name);

/// Writing with a fault of form: one pen-down for each stroke, in order, twice as many if written twice.
struct Malformed {
  std::vector<calligraphy::PenPath> paths;  ///< those of the pen in the size of the character [em]
  std::vector<int> strokes;                 ///< any of which a remark must name, from 0; none: it is of the whole
};

/// The pen with this fault; std::nullopt if it has no such place, or if the result is as right in another order or
/// direction (林 with its parts exchanged, 三 upside down). Deterministic per seed.
std::optional<Malformed> malform(const RightPen& pen, const FormRow& row, std::uint64_t seed);

/// The pen-downs in the size and at the place of the character, by the longer sides and the centres of their boxes.
std::vector<calligraphy::PenPath> in_size_of(const calligraphy::Character& character,
                                             const std::vector<calligraphy::PenPath>& paths);

/// As it lies about the centre of its box.
std::vector<calligraphy::PenPath> lying(const std::vector<calligraphy::PenPath>& paths,
                                        calligraphy::WritingOrientation orientation);

}  // namespace calligraphy_test
