// hanzi-writer-data (Make Me a Hanzi): the medians of brush strokes, a JSON file per character.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <calligraphy/model/character.hpp>

namespace calligraphy {

/// The medians of one character's file, in writing order [em]. 1024 units to the em, baseline at -124: mapped to the
/// unit square, y up. `name` is used in messages.
/// @throws FormatError naming the place
std::vector<std::vector<Point>> parse_hanzi_writer(std::string_view json, const std::string& name);

/// Reads and fits one character of the unpacked npm package: `directory`/北.json.
/// @throws FileError when there is no such file, FormatError naming the file and the place
Character read_hanzi_writer(const std::string& directory, char32_t code);

}  // namespace calligraphy
