// Encoding of characters as a set file (docs/set-file.md).
#pragma once

#include <cstddef>
#include <vector>

#include <calligraphy/model/character_list.hpp>

namespace calligraphy {

/// Precision of the control points and the ink in a set file. A valid character stays valid at any precision: one that
/// rounding would invalidate, or that lies far outside the em square, is stored more precisely than the others.
enum class CoordinatePrecision {
  coarse,    ///< steps of 1/200 em: 8 bits per coordinate; ink in steps of 1/400 em
  standard,  ///< steps of 1/800 em: 10 bits; the same for ink
  fine,      ///< steps of 1/12800 em: 14 bits; the same for ink
  exact      ///< unquantised: 64 bits
};

/// Maximum distance between a stored control point and the original one [em]: half the diagonal of a step, plus
/// rounding of doubles. It also bounds the error of strokes, since two curves are no farther apart than their control
/// points.
double coordinate_error_bound(CoordinatePrecision precision) noexcept;

/// Maximum difference between a stored half-width, offset, start or end of ink and the original one [em]: half a step,
/// plus rounding of doubles.
double ink_error_bound(CoordinatePrecision precision) noexcept;

/// Encodes characters as the bytes of a set file. The same characters give the same bytes.
/// @throws ValueError naming the character if one is invalid, is not a Unicode character, has more than 4096 strokes or
/// 255 orders, or occurs twice in the same order; if the name of an order is invalid, a text is not UTF-8, or the file
/// would be larger than 4 GiB
std::vector<std::byte> encode_character_set(const CharacterList& set,
                                            CoordinatePrecision precision = CoordinatePrecision::standard);

}  // namespace calligraphy
