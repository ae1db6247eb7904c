// Characters in memory, as they are drawn, imported or edited, and the text format for them.
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include <calligraphy/model/character.hpp>
#include <calligraphy/model/provenance.hpp>

namespace calligraphy {

/// Characters with where they come from.
struct CharacterList {
  Provenance provenance;
  std::vector<Character> characters;

  /// The character in the standard order or in the one of this name, or null. O(characters).
  const Character* find(char32_t code, std::string_view order = {}) const noexcept;
};

/// The characters drawn for this library, at least one for every typical stroke. Parsed once, on first use.
const CharacterList& built_in_characters();

/// The five-stroke character of Table 3, verbatim: ids 2, 1, 10, 31, 4; 15 control points, 13 feature points. It is 北
/// with the pie last; built_in_characters() has 北 in the standard order.
const Character& paper_example();

/// Reads the text format of docs/character-format.md. `name` is used in messages.
/// @throws FormatError naming the line and the value; nothing is returned in part
CharacterList read_characters(std::istream& in, std::string_view name);
/// @throws FileError when the file cannot be opened, FormatError as above
CharacterList read_characters(const std::string& path);

/// Writes the text format; read_characters gives back the same set (numbers in the shortest form that reads back the
/// same).
/// @throws ValueError when source, licence or attribution is more than one line, when the licence text has a carriage
/// return, or when an order's name is not fit to be one
void write_characters(std::ostream& out, const CharacterList& set);

}  // namespace calligraphy
