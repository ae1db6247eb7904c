#include <calligraphy/model/character_list.hpp>

#include <cstdint>
#include <string>

#include <calligraphy/model/typical_stroke.hpp>

#include "base/charconv.hpp"

namespace calligraphy {
namespace {

Character character_of(const TypicalStroke& type, char32_t code) {
  StrokeInput stroke{type.id, {}};
  for (const auto& [x, y] : type.shape) stroke.control_points.emplace_back(x, y);
  return make_character(code, {&stroke, 1});
}

CharacterList all_strokes() {
  CharacterList list;
  list.provenance = {"Typical strokes of calligraphy", "MIT", "The calligraphy authors", ""};
  for (const TypicalStroke& type : typical_strokes()) {
    list.characters.push_back(character_of(type, typical_stroke_code(type.id)));
    std::uint32_t code = 0;
    const std::string_view digits = type.unicode.substr(0, type.unicode.find(' '));
    from_chars(digits.data(), digits.data() + digits.size(), code, 16);
    list.characters.push_back(character_of(type, code));
    if (digits != type.unicode) list.characters.back().order = std::to_string(type.id);
  }
  return list;
}

}  // namespace

char32_t typical_stroke_code(int id) {
  typical_stroke(id);
  const auto offset = static_cast<char32_t>(id);
  if (id <= 20) return U'\u2460' + (offset - 1);  // Unicode has the circled numbers in three runs
  return id <= 35 ? U'\u3251' + (offset - 21) : U'\u32B1' + (offset - 36);
}

const CharacterList& typical_stroke_characters() {
  static const CharacterList list = all_strokes();
  return list;
}

}  // namespace calligraphy
