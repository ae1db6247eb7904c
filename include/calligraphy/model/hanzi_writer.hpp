// Real characters from hanzi-writer-data (Make Me a Hanzi): medians to typical strokes.
#pragma once

#include <string>

#include <calligraphy/model/character.hpp>

namespace calligraphy {

/// Reads one character from the unpacked npm package hanzi-writer-data: `directory`/北.json.
/// 1024 units to the em, baseline at -124: mapped to the unit square, y up.
/// @throws FileError when there is no such file, FormatError naming the file and the place
Character read_hanzi_writer(const std::string& directory, char32_t code);

}  // namespace calligraphy
