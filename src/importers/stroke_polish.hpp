// Minimises the maximum distance between a path and a stroke; private to the importers.
#pragma once

#include <span>
#include <vector>

#include <calligraphy/model/typical_stroke.hpp>

#include "polyline.hpp"

namespace calligraphy::recognition {

/// Control points of the typical stroke that follow the path most closely, starting from an initial guess: minimises
/// the maximum distance, path to stroke and stroke to path, by Newton's method on sums of increasing powers of the
/// distances. Smooth joints stay smooth. Bounded time: O(points of the path) per step, at most 60 steps. The steps of
/// `path` should not exceed about 0.02 em, because only its vertices are considered.
std::vector<Point> polished(const TypicalStroke& type, const Path& path, std::vector<Point> control_points);

}  // namespace calligraphy::recognition
