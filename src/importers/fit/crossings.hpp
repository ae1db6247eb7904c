// Strokes of a character that cross each other; private to the importers.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <calligraphy/model/character.hpp>

#include "polyline.hpp"

namespace calligraphy::recognition {

/// Where two paths cross, as arc lengths [em].
struct Crossing {
  double on_one;
  double on_other;
};

/// The first place on `one` where the paths cross; none if they do not. O(product of their lengths).
std::optional<Crossing> crossing_of(std::span<const Point> one, std::span<const Point> other);

/// Two strokes of a character that cross in the source.
struct CrossingStrokes {
  std::size_t one;
  std::size_t other;
  Crossing at;
};

/// The path of a source stroke without a half-width of the brush at either end: strokes that cross there only touch.
Path without_ends(std::span<const Point> path, double half_width);

/// All pairs of paths that cross. O(paths^2).
std::vector<CrossingStrokes> crossing_strokes(std::span<const Path> paths);

/// Extends strokes at an end, along its direction, where they cross in the source near that end but, as fitted, do not,
/// or so narrowly that rounding may undo it. Returns the strokes that it changed.
std::vector<std::size_t> keep_crossings(std::span<const CrossingStrokes> crossings, std::span<const Path> sources,
                                        std::span<StrokeInput> strokes);

}  // namespace calligraphy::recognition
