#include "file_name.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/character_text.hpp>

#include "base/charconv.hpp"

namespace calligraphy {
namespace {

constexpr std::size_t max_order = 64;  // [byte]
constexpr char32_t max_code = 0x10FFFF;

bool is_letter_or_digit(char c) { return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

bool is_word(std::string_view text) {
  return !text.empty() && text.size() <= max_order && std::all_of(text.begin(), text.end(), is_letter_or_digit);
}

/// 0: no code point in these digits.
char32_t number_in(std::string_view digits, int base) {
  constexpr std::size_t fewest = 4, most = 7;
  unsigned code = 0;
  if (digits.size() < fewest || digits.size() > most) return 0;
  const char* const end = digits.data() + digits.size();
  const auto [rest, error] = from_chars(digits.data(), end, code, base);
  return error == std::errc() && rest == end && code <= max_code ? code : 0;
}

/// As in %E4%B8%80; what is not encoded stays as it is.
std::string percent_decoded(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned byte = 0;
    const char* const digits = text.data() + i + 1;
    const bool is_encoded =
        text[i] == '%' && i + 2 < text.size() && from_chars(digits, digits + 2, byte, 16).ptr == digits + 2;
    plain += is_encoded ? static_cast<char>(byte) : text[i];
    if (is_encoded) i += 2;
  }
  return plain;
}

/// The only character of a text, unless it is of an alphabet: in a zip, two bytes of GBK may look like such a letter.
char32_t only_character(const std::string& text) {
  try {
    const std::vector<TextCharacter> characters = text_characters(text);
    constexpr char32_t radicals = 0x2E80;
    if (characters.size() == 1 && characters[0].written >= radicals) return characters[0].written;
  } catch (const FormatError&) {  // the name is in another encoding
  }
  return 0;
}

/// U+4E00, u4e00, uni4E00.
char32_t unicode_notation(std::string_view stem) {
  for (const std::string_view prefix : {"U+", "u+", "uni", "U", "u"}) {
    if (stem.starts_with(prefix)) return number_in(stem.substr(prefix.size()), 16);
  }
  return 0;
}

/// Without the number that browsers put behind the name of a file that they have already: 永 (1).
std::string_view without_copy_number(std::string_view stem) {
  const std::size_t open = stem.rfind(" (");
  if (open == stem.npos || !stem.ends_with(')')) return stem;
  const std::string_view number = stem.substr(open + 2, stem.size() - open - 3);
  const bool is_number = !number.empty() && number.find_first_not_of("0123456789") == number.npos;
  return is_number ? stem.substr(0, open) : stem;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return lower;
}

/// Sets the codes of a name without its extension.
void read_stem(std::string_view stem, FileName& name) {
  name.code = only_character(percent_decoded(stem));
  if (name.code == 0) name.code = unicode_notation(stem);
  if (name.code != 0) return;
  constexpr std::size_t digits = 5;  // KanjiVG's
  if (name.form == FileForm::svg) {
    if (stem.size() == digits || (stem.size() > digits && stem[digits] == '-' && is_word(stem.substr(digits + 1)))) {
      name.hex = number_in(stem.substr(0, digits), 16);
      if (stem.size() > digits && name.hex != 0) name.order = stem.substr(digits + 1);
    }
    name.decimal = number_in(stem, 10);
    return;
  }
  // Ideographs have at least five decimal digits; hexadecimal ones of five have a letter or a zero in front.
  const bool is_hexadecimal = stem.size() < digits || stem.starts_with('0') || number_in(stem, 10) == 0;
  name.code = number_in(stem, is_hexadecimal ? 16 : 10);
}

std::string_view last_part(std::string_view path) { return path.substr(path.rfind('/') + 1); }

bool is_of_macos(std::string_view path) {
  return last_part(path).starts_with("._") || path.starts_with("__MACOSX/") || path.find("/__MACOSX/") != path.npos;
}

/// Of a name such as graphics.txt, what follows "graphics".
std::optional<std::string_view> list_suffix(std::string_view name) {
  constexpr std::string_view begin = "graphics", end = ".txt";
  if (name.size() < begin.size() + end.size() || !name.starts_with(begin) || !name.ends_with(end)) return std::nullopt;
  const std::string_view suffix = name.substr(begin.size(), name.size() - begin.size() - end.size());
  return suffix.empty() || is_word(suffix) ? std::optional(suffix) : std::nullopt;
}

}  // namespace

FileName parse_file_name(std::string_view path) {
  FileName name;
  const std::string_view last = last_part(path);
  const std::size_t dot = last.rfind('.');
  if (dot == last.npos || is_of_macos(path)) return name;
  const std::string extension = lower_case(last.substr(dot));
  if (list_suffix(last)) {
    name.form = FileForm::list;
  } else if (extension == ".svg" || extension == ".json") {
    name.form = extension == ".svg" ? FileForm::svg : FileForm::json;
    read_stem(without_copy_number(last.substr(0, dot)), name);
  }
  return name;
}

bool is_anim_cjk_list(std::string_view path) {
  const std::optional<std::string_view> suffix = list_suffix(last_part(path));
  return suffix && !suffix->empty();
}

}  // namespace calligraphy
