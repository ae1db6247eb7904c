// The character that a file of a source draws, according to its name; private to the importers.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <calligraphy/importers/character_import.hpp>

namespace calligraphy {

struct CharacterFile {
  SourceKind kind;
  char32_t code;
  std::string order;  ///< empty for the standard one
};

/// From the path of a file within the source; empty if it names no character.
std::optional<CharacterFile> character_file(std::string_view path);

}  // namespace calligraphy
