#include <calligraphy/base/text.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include <utf8.h>

#include <calligraphy/base/error.hpp>

namespace calligraphy {

bool is_utf8(std::string_view text) noexcept { return utf8::is_valid(text.begin(), text.end()); }

bool is_utf16(std::string_view text) noexcept {
  constexpr std::size_t sample = 64;  // [byte], of letters, digits and signs as every format has them in front
  const bool has_mark = text.starts_with("\xFE\xFF") || text.starts_with("\xFF\xFE");
  if (text.size() < 4) return has_mark && text.size() == 3;  // of a line that ended within a character
  if (has_mark) return true;
  const std::string_view front = text.substr(0, std::min(text.size(), sample) / 2 * 2);
  std::size_t zeros[2] = {0, 0};
  for (std::size_t i = 0; i < front.size(); ++i) zeros[i % 2] += front[i] == '\0' ? 1 : 0;
  const auto [fewer, more] = std::minmax(zeros[0], zeros[1]);
  return 8 * fewer <= more && 4 * (fewer + more) > front.size();  // some of an ideograph such as U+4E00 are elsewhere
}

std::u32string decode_utf8(std::string_view text) {
  if (is_utf16(text)) throw FormatError("text is UTF-16, not UTF-8: save it as UTF-8");
  const auto invalid = utf8::find_invalid(text.begin(), text.end());
  if (invalid != text.end()) {
    throw FormatError("text is not UTF-8 (byte " + std::to_string(std::distance(text.begin(), invalid)) +
                      " is invalid): save it as UTF-8");
  }
  std::u32string codes;
  utf8::utf8to32(text.begin(), text.end(), std::back_inserter(codes));
  return codes;
}

std::string encode_utf8(char32_t code) {
  if (code > U'\U0010FFFF' || (code >= 0xD800 && code <= 0xDFFF)) {
    throw ValueError("code point " + std::to_string(static_cast<std::uint32_t>(code)) + " is not a Unicode character");
  }
  std::string text;
  utf8::append(code, std::back_inserter(text));
  return text;
}

std::string printable(std::string_view text) {
  std::string shown;
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view rest = text.substr(at);
    const auto valid = static_cast<std::size_t>(
        std::distance(rest.begin(), utf8::find_invalid(rest.begin(), rest.end())));
    std::u32string codes;  // not by decode_utf8(), which refuses what looks like UTF-16
    utf8::utf8to32(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(valid), std::back_inserter(codes));
    for (const char32_t code : codes) {
      const bool is_control = code < 0x20 || (code >= 0x7F && code < 0xA0);
      shown += is_control ? "?" : encode_utf8(code);
    }
    at += valid;
    if (at < text.size()) shown += '?', ++at;
  }
  return shown;
}

}  // namespace calligraphy
