// hanzi-writer-data (Make Me a Hanzi): outlines and medians of brush strokes, one JSON file per character.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

struct BrushStroke {
  std::vector<Point> median;   ///< in writing direction [em]
  std::vector<Point> outline;  ///< vertices of a closed polygon within 5e-4 em of the outline [em]; may be empty
};

/// The strokes in the file of one character, in writing order. The file has 1024 units per em and the baseline at -124;
/// the result is in the unit square, y up. Outlines are empty if the file has none. `name` is used in messages.
/// @throws FormatError naming the place
std::vector<BrushStroke> parse_hanzi_writer(std::string_view json, const std::string& name);

}  // namespace calligraphy
