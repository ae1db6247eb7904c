// Nearest points of many queries on a whole stroke or character.
#pragma once

#include <span>
#include <vector>

#include <calligraphy/collision/nearest_point.hpp>

namespace calligraphy {

/// A point on a stroke.
struct StrokePoint {
  int element = 0;       ///< index of its element
  NearestPoint closest;  ///< on that element
};

/// A point on a character.
struct CharacterPoint {
  int stroke = 0;        ///< index of its stroke
  int element = 0;       ///< index of its element within the stroke
  NearestPoint closest;  ///< on that element
};

/// Nearest points of many queries on a stroke, given as its elements: `results[i]` belongs to `queries[i]`, and its
/// `closest` is that of nearest_point() on that element to the last bit. Of distances that are equal within rounding
/// the earlier element wins. A query that is not finite gives the start of the first element, a stroke without elements
/// the origin, with an infinite distance and the status not_finite. An element that cannot answer a query is ignored if
/// another can. If the spans differ in length, the excess of the longer one is ignored. Does not allocate.
void nearest_points(std::span<const StrokeElement> stroke, std::span<const Point> queries,
                    std::span<StrokePoint> results, const NearestPointOptions& options = {}) noexcept;

/// The same on a character, given as the elements of its strokes, such as place_elements() gives: of distances that are
/// equal within rounding the earlier stroke wins, and within a stroke the earlier element. A stroke without elements
/// counts but has no points.
void nearest_points(std::span<const std::vector<StrokeElement>> strokes, std::span<const Point> queries,
                    std::span<CharacterPoint> results, const NearestPointOptions& options = {}) noexcept;

}  // namespace calligraphy
