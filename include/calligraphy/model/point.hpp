// A point or vector in the plane.
#pragma once

#include <Eigen/Core>

namespace calligraphy {

/// A point or vector in the plane of the paper: in em within a character (unit square, y up), in metres on the page.
using Point = Eigen::Vector2d;

}  // namespace calligraphy
