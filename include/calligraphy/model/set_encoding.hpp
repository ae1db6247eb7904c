// Characters to the bytes of a set file (docs/set-file.md).
#pragma once

#include <cstddef>
#include <vector>

#include <calligraphy/model/character_list.hpp>

namespace calligraphy {

/// How finely a set file keeps control points. Whatever the precision, a character that is valid stays valid: one that
/// rounding would break, or that lies far outside the em square, is kept more finely than the others.
enum class CoordinatePrecision {
  coarse,    ///< steps of 1/200 em: 8 bits a coordinate
  standard,  ///< steps of 1/800 em: 10 bits
  fine,      ///< steps of 1/12800 em: 14 bits
  exact      ///< as they are: 64 bits
};

/// How far a stored control point may be from what it was, and so a stroke too, as a curve lies no farther from another
/// than their control points do: half a diagonal of a step, and what the arithmetic of doubles adds [em].
double coordinate_error_bound(CoordinatePrecision precision) noexcept;

/// The set as the bytes of a set file. The same characters give the same bytes.
/// @throws ValueError naming the character when one is not valid, is no Unicode character, has more than 4096 strokes
/// or 255 orders, or stands there twice in the same order, when an order's name is not fit to be one, when a text is
/// not UTF-8, or when the file would be larger than 4 GiB
std::vector<std::byte> encode_character_set(const CharacterList& set,
                                            CoordinatePrecision precision = CoordinatePrecision::standard);

}  // namespace calligraphy
