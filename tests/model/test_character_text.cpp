// Which characters a text has. Expected values are from the charts of Unicode.
#include "../catch.hpp"

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/character_text.hpp>

using namespace calligraphy;

TEST_CASE("radicals and compatibility ideographs mean their unified ideographs, others themselves") {
  CHECK(unified(U'\u2F00') == U'一');  // Kangxi radicals, the first and the last
  CHECK(unified(U'\u2FD5') == U'龠');
  CHECK(unified(U'\u2ED3') == U'长');  // CJK radical long one
  CHECK(unified(U'\uF900') == U'豈');  // compatibility ideographs, the first and the last of both blocks
  CHECK(unified(U'\uFAD9') == U'龎');
  CHECK(unified(U'\U0002F800') == U'丽');
  CHECK(unified(U'\U0002FA1D') == U'\U0002A600');
  for (const char32_t code : U"一永\u2E9A\u2FD6\uFA0E\uFA29\u31C0A") CHECK(unified(code) == code);
}

TEST_CASE("a text is its characters without spaces and code points that have no ink") {
  const auto written = [](std::string_view text) {
    std::u32string codes;
    for (const TextCharacter& each : text_characters(text)) codes += each.written;
    return codes;
  };
  CHECK(written("\uFEFF 永\u200B和\u00AD\u2060\u3000九\n\u202E年\U000E0020") == U"永和九年");
  CHECK(written("\u200D\uFE0F").empty());
  CHECK_THROWS_AS(written("\xE6\xB0"), FormatError);
}

TEST_CASE("a variation selector belongs to the character before it, and what is read otherwise than written is told") {
  const std::vector<TextCharacter> text = text_characters("葛\U000E0100\uFE00 \uFE01\u2F00\uFE02永");
  REQUIRE(text.size() == 3);
  CHECK(text[0].selector == U'\U000E0100');  // the second one in a row, and one after a space, belong to none
  CHECK(reading_note(text[0], U'葛') == "葛 (U+845B) is read without its variation selector, U+E0100");
  CHECK(text[1].code_in(built_in_characters()) == U'一');
  CHECK(reading_note(text[1], U'一') ==
        "\u2F00 (U+2F00) is read as 一 (U+4E00) without its variation selector, U+FE02");
  CHECK(reading_note(text[2], U'永').empty());
  CharacterList with_radical;  // a set that has what is written keeps it
  with_radical.characters.push_back(built_in_characters().at(U'一'));
  with_radical.characters.back().code = U'\u2F00';
  CHECK(text[1].code_in(with_radical) == U'\u2F00');
}
