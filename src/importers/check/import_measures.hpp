// How well imported strokes follow their source (docs/strokes.md); private to the importers.
#pragma once

#include <span>
#include <vector>

#include <calligraphy/model/ink_outline.hpp>

#include "imported_character.hpp"
#include "importers/fit/crossings.hpp"
#include "importers/fit/outline.hpp"
#include "importers/read/drawing.hpp"

namespace calligraphy {

/// Adds the measures to `result`, whose character is made of `strokes`. `outlines` and `crossings`: of the drawing.
void measure_import(const std::vector<SourceStroke>& drawn, const std::vector<recognition::Outline>& outlines,
                    const std::vector<StrokeInput>& strokes,
                    const std::vector<recognition::CrossingStrokes>& crossings, ImportedCharacter& result);

namespace recognition {

/// Measures the path of a stroke against the path that it was fitted to, drawn by a brush of this half-width [em].
/// Leaves place, id and distance empty.
StrokeMeasures measure_stroke(std::span<const Point> path, std::span<const Point> source, double half_width);

/// Measures the ink of one character's strokes against their outlines. `ends`: of their medians.
InkMeasures measure_ink(std::span<const Outline> outlines, std::span<const Point> ends,
                        std::span<const std::vector<InkDisc>> inks);

}  // namespace recognition
}  // namespace calligraphy
