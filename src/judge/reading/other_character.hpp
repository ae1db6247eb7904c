// Whether somebody wrote a character other than the one asked for.
#pragma once

#include <optional>
#include <span>

#include "character_features.hpp"
#include "stroke_reading.hpp"

namespace calligraphy {

/// A character to which the writing is nearer than to the one asked for.
struct OtherCharacter {
  char32_t code = 0;
  bool is_clear = true;       ///< clearly nearer; otherwise only a fault of form can show that it was written
  bool is_twin = false;       ///< the two differ so little that one fault of form may make one of the other
  bool is_lookalike = false;  ///< the two hardly differ
};

/// The nearest character with as many strokes, if the writing is nearer to it: clearly so if it is on its side of the
/// middle between the two. The measure is how far the writing is along the way from one character to the other; of two
/// that hardly differ, the ratio of the distances. The writing is turned upright, as in the reading; strokes in another
/// order or direction are not held against the character asked for.
std::optional<OtherCharacter> other_character(const CharacterFeatures& characters, const Character& asked_for,
                                              std::span<const PenPath> paths, const StrokeReading& reading);

}  // namespace calligraphy
