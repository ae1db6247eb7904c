// How well ink covers the outlines that it was fitted to; private to the importers.
#pragma once

#include <span>
#include <vector>

#include <calligraphy/importers/character_import.hpp>
#include <calligraphy/model/ink_outline.hpp>
#include <calligraphy/model/point.hpp>

namespace calligraphy::recognition {

/// The outlines of a character's strokes, closed polygons, and the ink of the same strokes: measures of one character.
InkMeasures measure_ink(std::span<const std::span<const Point>> outlines, std::span<const std::vector<InkDisc>> inks);

}  // namespace calligraphy::recognition
