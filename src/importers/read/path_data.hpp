// The subsets of SVG path data that centre lines and outlines of strokes use.
#pragma once

#include <string_view>
#include <vector>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// The curve of M/m, C/c and S/s as a polyline within `tolerance` of it, in the units of the data.
/// @throws FormatError naming the byte, also for any other command and for a second M
std::vector<Point> flattened_path(std::string_view data, double tolerance);

/// The vertices of one closed curve of M/m, L/l, Q/q, C/c and Z/z as a polygon within `tolerance` of it.
/// @throws FormatError as above
std::vector<Point> flattened_outline(std::string_view data, double tolerance);

}  // namespace calligraphy
