// Where characters come from: the built-in set, a file in the text format, or the unpacked package hanzi-writer-data.
#pragma once

#include <string>

#include <calligraphy/model/character_list.hpp>

namespace calligraphy::tools {

/// The characters of `text`, each once, with their source.
/// @param path empty: the built-in set; a directory: hanzi-writer-data; else a file
/// @throws Error naming the character or the file
CharacterList find_characters(const std::u32string& text, const std::string& path);

}  // namespace calligraphy::tools
