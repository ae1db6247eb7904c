// Whether somebody wrote a character other than the one asked for.
#pragma once

#include <optional>
#include <span>

#include "character_features.hpp"
#include "stroke_reading.hpp"

namespace calligraphy {

/// A character to which the writing is clearly nearer than to the one asked for.
struct OtherCharacter {
  char32_t code = 0;
  bool is_lookalike = false;  ///< the two hardly differ
};

/// The nearest character with as many strokes, if the writing is clearly on its side of the middle between the two. One
/// measure serves for strangers and near twins alike: how far the writing is along the way from one character to the
/// other. The writing is turned upright, as in the reading; strokes in another order or direction are not held against
/// the character asked for.
std::optional<OtherCharacter> other_character(const CharacterFeatures& characters, const Character& asked_for,
                                              std::span<const PenPath> paths, const StrokeReading& reading);

}  // namespace calligraphy
