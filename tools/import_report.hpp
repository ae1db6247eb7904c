// Report of `calligraphy import`, as tables and as JSON.
#pragma once

#include <string>

#include <calligraphy/importers/character_import.hpp>

namespace calligraphy::tools {

/// The file that was written.
struct ImportOutput {
  std::string file;
  std::string format;
  std::size_t bytes = 0;
};

std::string tables(const ImportResult& import, const ImportOutput& output);

/// What ink costs in a set file at standard precision, and how well it covers the outlines; of ink_figures().
std::string ink_table(const ImportResult& import);

std::string json(const ImportResult& import, const ImportOutput& output);

/// What a list has, counted as `calligraphy info` does.
struct Contents {
  int characters = 0;
  int strokes = 0;           ///< in the first order of each character, which is the standard one if it has that
  int alternate_orders = 0;  ///< not counting the first one of each character
};

/// Of a list in which the orders of a character stand together.
Contents contents_of(const CharacterList& list);

/// "2 characters, 5 strokes, 1 alternate stroke order"; without the last if there is none.
std::string to_string(const Contents& contents);

/// "永 (U+6C38)", followed by the name of the stroke order unless it is the standard one.
std::string character_label(char32_t code, const std::string& order);

}  // namespace calligraphy::tools
