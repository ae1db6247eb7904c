#include "character_file.hpp"

#include <algorithm>
#include <cstddef>
#include <system_error>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>

#include "base/charconv.hpp"

namespace calligraphy {
namespace {

constexpr std::size_t max_order = 64;  // [byte]

bool is_word(std::string_view text) {
  return !text.empty() && text.size() <= max_order && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
  });
}

/// 04e86.svg or 04e86-Kaisho.svg.
std::optional<CharacterFile> kanjivg_name(std::string_view stem) {
  constexpr std::size_t digits = 5;
  unsigned code = 0;
  if (stem.size() < digits) return std::nullopt;
  const char* const end = stem.data() + digits;
  const auto [rest, error] = from_chars(stem.data(), end, code, 16);
  if (error != std::errc() || rest != end || code == 0) return std::nullopt;
  if (stem.size() == digits) return CharacterFile{SourceKind::kanjivg, code, {}};
  if (stem[digits] != '-' || !is_word(stem.substr(digits + 1))) return std::nullopt;
  return CharacterFile{SourceKind::kanjivg, code, std::string(stem.substr(digits + 1))};
}

/// 永.json.
std::optional<CharacterFile> hanzi_writer_name(std::string_view stem) {
  try {
    const std::u32string codes = decode_utf8(stem);
    if (codes.size() == 1 && codes[0] > 0x7F) return CharacterFile{SourceKind::hanzi_writer_data, codes[0], {}};
  } catch (const FormatError&) {  // the name is in another encoding
  }
  return std::nullopt;
}

}  // namespace

std::optional<CharacterFile> character_file(std::string_view path) {
  const std::string_view name = path.substr(path.rfind('/') + 1);
  const std::size_t dot = name.rfind('.');
  if (dot == std::string_view::npos) return std::nullopt;
  if (name.substr(dot) == ".svg") return kanjivg_name(name.substr(0, dot));
  if (name.substr(dot) == ".json") return hanzi_writer_name(name.substr(0, dot));
  return std::nullopt;
}

}  // namespace calligraphy
