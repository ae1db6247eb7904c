// The characters of a text, as people type and paste it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace calligraphy {

/// A character of a text.
struct TextCharacter {
  char32_t written = 0;   ///< code point in the text
  char32_t meant = 0;     ///< unified(written)
  char32_t selector = 0;  ///< variation selector after it, which asks for one of its forms; 0: none

  /// The code point under which a character set has it: `written` if the set has that, otherwise `meant`.
  template <class Set>
  char32_t code_in(const Set& set) const {
    return set.find(written) ? written : meant;
  }
};

/// The unified ideograph that a compatibility ideograph or a radical stands for, such as 一 (U+4E00) for ⼀ (U+2F00);
/// otherwise the code point itself (Unicode 15: canonical equivalents, and Equivalent_Unified_Ideograph of the blocks of
/// radicals).
char32_t unified(char32_t code) noexcept;

/// Whether the code point asks for one of the forms of the character before it.
bool is_variation_selector(char32_t code) noexcept;

/// The characters of a text in UTF-8, in order, without white space and code points that have no ink, such as a
/// zero-width space (Default_Ignorable_Code_Point).
/// @throws FormatError naming the byte that is not UTF-8
std::vector<TextCharacter> text_characters(std::string_view text);

/// What a person is to be told about a character that is read as `code`: that it is another one than written, or that its
/// variation selector has no effect. Empty for most.
std::string reading_note(const TextCharacter& character, char32_t code);

}  // namespace calligraphy
