// hanzi-writer-data (Make Me a Hanzi): outlines and medians of brush strokes, one JSON file per character.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drawing.hpp"

namespace calligraphy {

/// A point of its drawings [unit] in the unit square, y up.
Point hanzi_writer_em(const Point& units);

/// The strokes in the file of one character, in writing order: medians, and outlines within 5e-4 em, empty if the file
/// has none. The file has 1024 units per em and the baseline at -124; the result is in the unit square, y up. `name` is
/// used in messages.
/// @throws FormatError naming the place
std::vector<SourceStroke> parse_hanzi_writer(std::string_view json, const std::string& name);

/// The member "character" of a JSON text, as far as it can be read; graphics.txt has it.
std::optional<std::string> character_member(std::string_view json);

}  // namespace calligraphy
