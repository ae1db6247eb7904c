// Ink for strokes whose source has none: the usual brush marks of their kind.
#pragma once

#include <calligraphy/model/character.hpp>
#include <calligraphy/model/stroke_ink.hpp>

namespace calligraphy {

/// The usual half-width of a stroke [em], given its kind, its length [em] and the number of strokes in its character,
/// learnt from hanzi-writer-data (docs/strokes.md): longer strokes are wider, and more strokes make each thinner.
/// @throws ValueError if the id is not in 1..39, or the count or length is not above zero
double typical_half_width(int id, int stroke_count, double length);

/// The typical ink of a stroke with this id, scaled to the half-width [em]. @throws ValueError if the id is not
/// in 1..39
StrokeInk typical_ink(int id, double half_width);

/// The same character with typical ink, or unchanged if it has ink of its own. The ink ends where the path does:
/// strokes are not extended.
Character with_typical_ink(Character character);

}  // namespace calligraphy
