// Pens that wrote a character right, as an assignment that does not know match_strokes() decides it.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include <calligraphy/judge/pen_path.hpp>
#include <calligraphy/model/character_set.hpp>

namespace calligraphy_test {

/// A pen that wrote every stroke of a character once, in order and forwards.
struct RightPen {
  std::string source;  ///< name of the file of traces, or "written" by the simulated writer
  calligraphy::Character character;
  std::vector<calligraphy::PenPath> paths;  ///< one for each stroke [em]
};

/// Whether the pen wrote each stroke of the character once, in order and forwards.
///
/// There are as many pen-downs as strokes, taps included. The pen is laid on the character by its bounding box: by the
/// centre and the scale of each axis, where a side below 25 % of the other, of either box, is scaled like the other.
/// The cost of a pen-down and a stroke is the mean distance of 8 points at equal arc length, the lesser of forwards and
/// backwards. Then
/// - no other assignment of the pen-downs costs less than that in order: the graph in which the edge from i to j weighs
///   cost(i, j) - cost(i, i) has no negative cycle;
/// - each pen-down is nearer to its stroke forwards than backwards, unless it is a single point, or the stroke's chord
///   is below half of its length, so that its reversal lies on itself.
bool is_right(const calligraphy::Character& character, std::span<const calligraphy::PenPath> paths);

/// Thresholds may be chosen on the characters of the other half only: this one is printed.
constexpr bool is_printed_half(char32_t code) { return code % 2 == 1; }

/// The traces of all .txt files of these directories, in the order of their names, that are right for the character of
/// one of the sets; the first such set counts.
std::vector<RightPen> pens_of_people(const std::vector<std::string>& directories,
                                     const std::vector<calligraphy::CharacterSet>& sets);

/// Characters spread evenly over a set, at most `count`.
std::vector<calligraphy::Character> spread_over(const calligraphy::CharacterSet& set, std::size_t count);

/// The characters as the simulated writer writes them with vision alone, novice and skilled alternately, without
/// mistakes of order or direction; those that are right.
std::vector<RightPen> written_pens(
    const std::vector<calligraphy::Character>& characters, std::uint64_t first_seed, int threads,
    const std::function<void(double)>& progress = [](double) {});

/// The middle lines of the characters, as pens of the source "medians".
std::vector<RightPen> medians(const std::vector<calligraphy::Character>& characters);

}  // namespace calligraphy_test
