// Conversion between UTF-8 text and code points.
#pragma once

#include <string>
#include <string_view>

namespace calligraphy {

/// Whether the whole text is valid UTF-8, as an empty one is.
bool is_utf8(std::string_view text) noexcept;

/// Whether the text begins as UTF-16 does: with its byte order mark, or with letters every other byte of which is zero.
bool is_utf16(std::string_view text) noexcept;

/// The code points of a UTF-8 text. @throws FormatError naming UTF-16 if it is that, or else the byte offset of the
/// first invalid sequence
std::u32string decode_utf8(std::string_view text);

/// One code point as UTF-8. @throws ValueError if it is a surrogate or above U+10FFFF
std::string encode_utf8(char32_t code);

/// The text as a terminal can show it: '?' replaces every control character and every byte that is not UTF-8.
std::string printable(std::string_view text);

}  // namespace calligraphy
