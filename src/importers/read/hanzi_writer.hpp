// hanzi-writer-data (Make Me a Hanzi): outlines and medians of brush strokes, one JSON file per character.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <calligraphy/model/character.hpp>

namespace calligraphy {

struct BrushStroke {
  std::vector<Point> median;   ///< in writing direction [em]
  std::vector<Point> outline;  ///< vertices of a closed polygon within 5e-4 em of the outline [em]; may be empty
};

/// The strokes in the file of one character, in writing order. The file has 1024 units per em and the baseline at -124;
/// the result is in the unit square, y up. Outlines are empty if the file has none. `name` is used in messages.
/// @throws FormatError naming the place
std::vector<BrushStroke> parse_hanzi_writer(std::string_view json, const std::string& name);

/// Reads and fits one character of the unpacked npm package: `directory`/北.json.
/// @throws FileError if there is no such file, FormatError naming the file and the place
Character read_hanzi_writer(const std::string& directory, char32_t code);

}  // namespace calligraphy
