// The cubic that follows points best, its ends given; private to the model.
#pragma once

#include <span>

#include <calligraphy/model/point.hpp>

namespace calligraphy::recognition {

/// Largest distance of the points to the cubic with these end points that fits them best in least squares.
/// `handles` receives its inner control points.
double fit_cubic(std::span<const Point> points, Point handles[2]);

}  // namespace calligraphy::recognition
