// How well ink covers the outlines that it was fitted to; private to the importers.
#pragma once

#include <span>
#include <vector>

#include <calligraphy/importers/character_import.hpp>
#include <calligraphy/model/ink_outline.hpp>
#include <calligraphy/model/point.hpp>

namespace calligraphy::recognition {

/// Measures the ink of one character's strokes against their outlines, which are closed polygons.
InkMeasures measure_ink(std::span<const std::span<const Point>> outlines, std::span<const std::vector<InkDisc>> inks);

}  // namespace calligraphy::recognition
