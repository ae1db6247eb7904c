// Least-squares fit of a cubic with given end points; private to the importers.
#pragma once

#include <span>

#include <calligraphy/model/point.hpp>

namespace calligraphy::recognition {

/// Maximum distance of the points from their least-squares cubic with these end points. `handles` receives its inner
/// control points.
double fit_cubic(std::span<const Point> points, Point handles[2]);

}  // namespace calligraphy::recognition
