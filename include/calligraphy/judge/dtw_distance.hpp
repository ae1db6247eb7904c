// How far apart two paths are, whatever the speed along them.
#pragma once

#include <span>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// Dynamic time warping distance between two paths, in the unit of their points: a mean distance of points that are
/// paired in order. Each path is resampled to 64 points at equal arc length, its ends included, so that neither its
/// speed nor its sampling matters; a path without length counts as 64 times its point. Points are paired from the first
/// two to the last two in steps of (1, 0), (0, 1) and (1, 1), at the cost of their Euclidean distance, with the weights
/// 1, 1 and 2 of the symmetric form of Sakoe and Chiba (1978), without a slope constraint or a window. The least sum,
/// divided by that of the weights, 64 + 64, does not depend on which of several best pairings is chosen or which path
/// comes first. It is 0 for identical paths, and equals the shift for a straight path shifted across its direction.
/// @throws ValueError when a path has no point, or one that is not finite
double dtw_distance(std::span<const Point> one, std::span<const Point> other);

}  // namespace calligraphy
