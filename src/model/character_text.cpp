#include <calligraphy/model/character_text.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>

#include <calligraphy/base/text.hpp>

#include "code_point_name.hpp"
#include "unicode_table.hpp"

namespace calligraphy {
namespace {

template <std::size_t count>
bool is_in(const CodeRange (&ranges)[count], char32_t code) noexcept {
  return std::any_of(std::begin(ranges), std::end(ranges),
                     [code](const CodeRange& range) { return code >= range.first && code <= range.last; });
}

}  // namespace

char32_t unified(char32_t code) noexcept {
  std::size_t index = 0;
  for (const CodeRange& block : unified_blocks) {
    if (code >= block.first && code <= block.last) {
      const char32_t ideograph = unified_ideographs[index + (code - block.first)];
      return ideograph == 0 ? code : ideograph;
    }
    index += block.last - block.first + 1;
  }
  return code;
}

bool is_variation_selector(char32_t code) noexcept { return is_in(variation_selectors, code); }

std::vector<TextCharacter> text_characters(std::string_view text) {
  std::vector<TextCharacter> characters;
  bool follows = false;  // directly on a character, as a selector does
  for (const char32_t code : decode_utf8(text)) {
    if (follows && is_variation_selector(code)) characters.back().selector = code;
    follows = !is_in(white_space, code) && !is_in(default_ignorable, code);
    if (follows) characters.push_back({code, unified(code), 0});
  }
  return characters;
}

std::string reading_note(const TextCharacter& character, char32_t code) {
  std::string note;
  if (code != character.written) {
    note = code_point_name(character.written) + " is read as " + code_point_name(code);
  }
  if (character.selector == 0) return note;
  return (note.empty() ? code_point_name(code) + " is read" : note) + " without its variation selector, " +
         code_point_number(character.selector);
}

}  // namespace calligraphy
