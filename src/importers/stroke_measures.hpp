// How closely imported strokes follow their source (docs/strokes.md); private to the importers.
#pragma once

#include <span>

#include <calligraphy/importers/character_import.hpp>

#include "polyline.hpp"

namespace calligraphy::recognition {

/// Measures of the path of a stroke against the path that it was fitted to, whose brush has this half-width [em]. The
/// place and the id are left empty.
StrokeMeasures measure_stroke(std::span<const Point> path, std::span<const Point> source, double half_width);

/// One stroke of a character: its path, what it was fitted to and the half-width of the brush there [em].
struct StrokeAndSource {
  Path path;
  Path source;
  double half_width;
};

/// Pairs of strokes that cross in the source, not within a half-width of an end, and how many of them cross as imported.
CrossingCount count_crossings(std::span<const StrokeAndSource> strokes);

}  // namespace calligraphy::recognition
