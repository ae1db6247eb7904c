// SVG path data as polylines.
#pragma once

#include <string_view>
#include <vector>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// What a path draws from one M to the next.
struct Subpath {
  std::vector<Point> points;
  bool is_closed = false;  ///< by Z, which draws to the first point
};

/// The subpaths, each a polyline within `tolerance` of it, in the units of the data. Reads all of SVG 2's grammar; arcs
/// as its notes on implementation have it. An M that draws nothing is left out, unless it is all there is.
/// @throws FormatError naming the byte
std::vector<Subpath> flattened(std::string_view data, double tolerance);

/// The only subpath; one that is closed ends where it begins. @throws FormatError as above, also if there are several
std::vector<Point> flattened_path(std::string_view data, double tolerance);

/// The closed subpaths as polygons, which SVG fills by the nonzero rule.
/// @throws FormatError as above, also if a subpath is not closed
std::vector<std::vector<Point>> flattened_outline(std::string_view data, double tolerance);

}  // namespace calligraphy
