// How imported strokes follow their source (docs/strokes.md); private to the importers.
#pragma once

#include <span>

#include <calligraphy/importers/character_import.hpp>

#include "importers/fit/polyline.hpp"

namespace calligraphy::recognition {

/// Measures of the path of a stroke against the path that it was fitted to, whose brush has this half-width [em].
/// Place, id and distance are left empty.
StrokeMeasures measure_stroke(std::span<const Point> path, std::span<const Point> source, double half_width);

}  // namespace calligraphy::recognition
