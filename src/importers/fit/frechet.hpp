// The distance between two paths, which respects their order; private to the importers.
#pragma once

#include <span>

#include <calligraphy/model/character.hpp>

#include "polyline.hpp"

namespace calligraphy::recognition {

/// Discrete Fréchet distance of a path to its source [em] (Eiter and Mannila 1994): the shortest leash with which one
/// can walk along both at once without going back. Points are placed every `step` [em], at most 1,200 on each: the
/// result is at most one step above the distance of the curves and, where it passes a vertex, half a step below. The
/// path may begin anywhere on the source within `free` [em] of its start, and end as near its end.
/// O(product of the numbers of points).
double frechet_distance(std::span<const Point> path, std::span<const Point> source, double free, double step);

/// FittedStroke::error of a stroke whose source was drawn by a brush of this half-width [em].
double fit_error(const StrokeInput& stroke, std::span<const Point> source, double half_width);

}  // namespace calligraphy::recognition
