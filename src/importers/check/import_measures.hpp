// Measures the strokes of an imported character against its drawing; private to the importers.
#pragma once

#include <vector>

#include <calligraphy/model/character.hpp>

#include "imported_character.hpp"
#include "importers/fit/crossings.hpp"
#include "importers/read/drawing.hpp"

namespace calligraphy {

/// Adds the measures to `result`, whose character is made of `strokes`. `crossings`: those of the drawing.
void measure_import(const std::vector<DrawnStroke>& drawn, const std::vector<StrokeInput>& strokes,
                    const std::vector<recognition::CrossingStrokes>& crossings, ImportedCharacter& result);

}  // namespace calligraphy
