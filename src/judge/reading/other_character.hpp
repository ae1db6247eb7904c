// Whether somebody wrote another character than the one that was asked for.
#pragma once

#include <optional>
#include <span>

#include "character_features.hpp"
#include "stroke_reading.hpp"

namespace calligraphy {

/// A character that the writing is clearly nearer to than to the one that was asked for.
struct OtherCharacter {
  char32_t code = 0;
  bool is_lookalike = false;  ///< the two hardly differ
};

/// The nearest character of as many strokes, if the writing lies clearly on its side of the middle between both. One
/// measure for strangers and near twins alike: the place of the writing on the way from one character to the other. The
/// writing is turned upright, as the reading has it; its strokes in another order or direction are not held against the
/// character that was asked for.
std::optional<OtherCharacter> other_character(const CharacterFeatures& characters, const Character& asked_for,
                                              std::span<const PenPath> paths, const StrokeReading& reading);

}  // namespace calligraphy
