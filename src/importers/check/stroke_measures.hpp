// How well imported strokes follow their source (docs/strokes.md); private to the importers.
#pragma once

#include <span>

#include <calligraphy/importers/character_import.hpp>

#include "importers/fit/polyline.hpp"

namespace calligraphy::recognition {

/// Measures the path of a stroke against the path that it was fitted to, drawn by a brush of this half-width [em].
/// Leaves place, id and distance empty.
StrokeMeasures measure_stroke(std::span<const Point> path, std::span<const Point> source, double half_width);

}  // namespace calligraphy::recognition
