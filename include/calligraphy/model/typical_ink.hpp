// Ink for strokes whose source has none: as a brush usually writes their kind.
#pragma once

#include <calligraphy/model/character.hpp>
#include <calligraphy/model/stroke_ink.hpp>

namespace calligraphy {

/// The usual half-width of a stroke of a kind and length [em] in a character of so many strokes, learnt from
/// hanzi-writer-data (docs/strokes.md) [em]: wider the longer the stroke is, and thinner the more there are.
/// @throws ValueError if the id is not in 1..39, or a count or length not above zero
double typical_half_width(int id, int stroke_count, double length);

/// The typical ink of a stroke with this id, scaled to the half-width [em]. @throws ValueError if the id is not
/// in 1..39
StrokeInk typical_ink(int id, double half_width);

/// The same character with typical ink, or as it is if it has ink of its own. The ink ends where the path does: strokes
/// are not drawn out.
Character with_typical_ink(Character character);

}  // namespace calligraphy
