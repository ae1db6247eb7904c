// Control points of a stroke that follows a path in its order; private to the importers.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include <calligraphy/model/typical_stroke.hpp>

#include "polyline.hpp"

namespace calligraphy::recognition {

/// Fits the control points of a stroke of this type, with these elements, to a path of evenly spaced points, given the
/// points where its elements begin and the last one ends. Linear least squares for all control points alternates with
/// the assignment of each point of the path to the nearest place on the stroke, in the order of both.
/// Smooth joints stay smooth; the ends of the stroke are near those of the path.
std::vector<Point> fit_control_points(const TypicalStroke& type, std::string_view elements, const Path& path,
                                      std::span<const std::size_t> ends);

}  // namespace calligraphy::recognition
