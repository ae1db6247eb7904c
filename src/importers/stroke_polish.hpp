// Moves control points until the largest distance between a path and a stroke is least; private to the model.
#pragma once

#include <span>
#include <vector>

#include <calligraphy/model/typical_stroke.hpp>

#include "polyline.hpp"

namespace calligraphy::recognition {

/// The control points of the typical stroke that follow the path most closely near a first guess: the largest distance,
/// path to stroke and stroke to path, is as small as Newton's method on sums of rising powers of the distances brings
/// it. Joints called smooth stay smooth. Bounded time: O(points of the path) per step, at most 60 steps.
/// `path` should have no step longer than about 0.02 em: its vertices are what is kept near.
std::vector<Point> polished(const TypicalStroke& type, const Path& path, std::vector<Point> control_points);

}  // namespace calligraphy::recognition
