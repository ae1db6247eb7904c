// The path data of SVG, as far as centre lines of strokes use it.
#pragma once

#include <string_view>
#include <vector>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// The curve of M/m, C/c and S/s as a polyline no farther than `tolerance` from it, in the units of the data.
/// @throws FormatError naming the byte, for every other command and for a second M, too
std::vector<Point> flattened_path(std::string_view data, double tolerance);

}  // namespace calligraphy
