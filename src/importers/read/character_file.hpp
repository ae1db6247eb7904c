// Which character a file of a source draws, as its name says; private to the importers.
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

/// From a path within the source; nothing if that names no character.
std::optional<CharacterFile> character_file(std::string_view path);

}  // namespace calligraphy
