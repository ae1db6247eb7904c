// Characters in memory, for drawing, importing and editing, and their text format.
#pragma once

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include <calligraphy/model/character.hpp>
#include <calligraphy/model/provenance.hpp>

namespace calligraphy {

/// Characters and their provenance.
struct CharacterList {
  Provenance provenance;              ///< of all of them
  std::vector<Character> characters;  ///< in any order; one with several stroke orders occurs once for each

  /// The character in the stroke order of this name (empty: the standard one), or null. O(characters).
  const Character* find(char32_t code, std::string_view order = {}) const noexcept;
  /// The same. @throws ValueError naming the character and the number of characters in the list if it is not there
  const Character& at(char32_t code, std::string_view order = {}) const;
};

/// The characters drawn for this library; every typical stroke occurs in at least one. Parsed once, on first use.
const CharacterList& built_in_characters();

/// The five-stroke character of Table 3, verbatim: ids 2, 1, 10, 31, 4; 15 control points, 13 feature points. It is 北
/// with a bend made of lines and the pie written last; built_in_characters() has 北 in the standard order.
const Character& paper_example();

/// The code point under which typical_stroke_characters() has a typical stroke by its number: ① (U+2460) to ㊴ (U+32B4).
/// @throws ValueError if id is not in 1..39
char32_t typical_stroke_code(int id);

/// The 39 typical strokes, each to be practised alone: a character of one stroke for each typical_stroke_code(), and one
/// for each CJK stroke from ㇀ (U+31C0) to ㇥ (U+31E5) but the two that are no typical stroke. A variant, such as the
/// short pie, is a stroke order of its CJK stroke that is named after its number, "5".
const CharacterList& typical_stroke_characters();

/// Reads the text format of docs/character-format.md. `name` is used in messages.
/// @throws FormatError naming the line and the value
CharacterList read_characters(std::istream& in, std::string_view name);
/// Reads a file in this format. @throws FileError if it cannot be opened; FormatError as above
CharacterList read_characters(const std::string& path);

/// Writes the text format. read_characters() restores the same list: numbers are written in their shortest form that
/// round-trips.
/// @throws ValueError if source, licence or attribution has more than one line, the licence text contains a carriage
/// return, or the name of a stroke order is invalid
void write_characters(std::ostream& out, const CharacterList& set);

}  // namespace calligraphy
