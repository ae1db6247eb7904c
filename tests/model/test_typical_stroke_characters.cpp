// The typical strokes as characters of one stroke.
#include "../catch.hpp"

#include <string>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/character_set.hpp>
#include <calligraphy/model/typical_stroke.hpp>

using namespace calligraphy;

TEST_CASE("each typical stroke is a character by its number and by its CJK stroke, with its own shape") {
  const CharacterList& list = typical_stroke_characters();
  for (const TypicalStroke& type : typical_strokes()) {
    const std::string variant = type.unicode.ends_with("var") ? std::to_string(type.id) : "";
    const auto code = static_cast<char32_t>(std::stoul(std::string(type.unicode), nullptr, 16));
    for (const Character* const found : {list.find(typical_stroke_code(type.id)), list.find(code, variant)}) {
      REQUIRE(found != nullptr);
      REQUIRE(found->stroke_count() == 1);
      const Stroke stroke = strokes(*found).front();
      CHECK(stroke.type->id == type.id);
      for (std::size_t i = 0; i < type.shape.size(); ++i) {
        CHECK(stroke.control_points[i] == Point(type.shape[i][0], type.shape[i][1]));
      }
    }
  }
  CHECK(list.characters.size() == 78);
  CHECK(CharacterSet(list).forms(U'\u31D2').size() == 2);  // pie and the short pie
}

TEST_CASE("strokes are numbered by the circled numbers of Unicode") {
  const std::u32string expected = U"①②③④⑤⑥⑦⑧⑨⑩⑪⑫⑬⑭⑮⑯⑰⑱⑲⑳㉑㉒㉓㉔㉕㉖㉗㉘㉙㉚㉛㉜㉝㉞㉟㊱㊲㊳㊴";
  for (int id = 1; id <= typical_stroke_count; ++id) {
    CHECK(typical_stroke_code(id) == expected[static_cast<std::size_t>(id - 1)]);
  }
  CHECK_THROWS_AS(typical_stroke_code(0), ValueError);
  CHECK_THROWS_AS(typical_stroke_code(40), ValueError);
}
