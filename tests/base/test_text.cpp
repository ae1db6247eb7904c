// UTF-8 to code points and back.
#include "../catch.hpp"

#include <string>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>

namespace text_tests {

using namespace calligraphy;

namespace {

std::string complaint(std::string_view text) {
  try {
    decode_utf8(text);
  } catch (const FormatError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("code points of one to four bytes are decoded", "[model]") {
  CHECK(decode_utf8("").empty());
  CHECK(is_utf8("A\xC3\xA9"));
  CHECK_FALSE(is_utf8("\xC3"));
  CHECK(decode_utf8("A\xC3\xA9\xE6\xB0\xB8\xF0\xA0\x80\x80") == U"A\u00E9\u6C38\U00020000");
}

TEST_CASE("UTF-16 is told by its name, with and without a byte order mark", "[model]") {
  using namespace std::string_literals;
  for (const std::string& text : {"\xFF\xFE\x38\x6C"s, "\xFE\xFF\x6C\x38"s, "C\0 \0\x38\x6C"s, "\0C\0 \x6C\x38"s,
                                  "s\0e\0t\0 \0o\0n\0e\0:\0\0\x4E"s}) {
    CHECK(complaint(text) == "text is UTF-16, not UTF-8: save it as UTF-8");
  }
  CHECK_FALSE(is_utf16("永"));
  CHECK_FALSE(is_utf16("\0\0\0\0"s));
}

TEST_CASE("encoding undoes decoding over the whole of Unicode", "[model]") {
  int wrong = 0;
  for (char32_t code = 0; code <= 0x10FFFF; code += code < 0x3000 ? 1 : 97) {
    if (code >= 0xD800 && code <= 0xDFFF) continue;
    wrong += decode_utf8(encode_utf8(code)) != std::u32string(1, code);
  }
  CHECK(wrong == 0);
}

TEST_CASE("a code point that is not a character is rejected", "[model]") {
  for (const char32_t code : {char32_t{0xD800}, char32_t{0xDFFF}, char32_t{0x110000}, char32_t{0xFFFFFFFF}}) {
    CHECK_THROWS_AS(encode_utf8(code), ValueError);
  }
}

TEST_CASE("the first invalid sequence is named by its byte offset", "[model]") {
  CHECK(complaint("\xFF").find("byte 0 ") != std::string::npos);
  CHECK(complaint("\xE6\xB0\xB8\xE5").find("byte 3 ") != std::string::npos);   // truncated
  CHECK(complaint("ab\xC0\xAF").find("byte 2 ") != std::string::npos);         // overlong '/'
  CHECK(complaint("abc\xED\xA0\x80").find("byte 3 ") != std::string::npos);    // surrogate
  CHECK(complaint("a\xF4\x90\x80\x80").find("byte 1 ") != std::string::npos);  // above U+10FFFF
  CHECK(complaint("a\x80").find("byte 1 ") != std::string::npos);              // stray continuation
}

TEST_CASE("text is UTF-8 only when all of it is", "[base]") {
  CHECK(is_utf8(""));
  CHECK(is_utf8("p\xC3\xA4per \xE6\xB0\xB8"));
  CHECK_FALSE(is_utf8("p\xE4per"));
  CHECK_FALSE(is_utf8("\xC3"));
}

TEST_CASE("what a terminal would take for a command, or not understand, is shown as a question mark", "[base]") {
  CHECK(printable("").empty());
  CHECK(printable(std::string("c\0a\0", 4)) == "c?a?");
  CHECK(printable("p\xC3\xA4per \xE6\xB0\xB8") == "p\xC3\xA4per \xE6\xB0\xB8");
  CHECK(printable(std::string("\0\n\x1B[1m\x7F", 7)) == "???[1m?");
  CHECK(printable("a\xC2\x9B") == "a?");  // a control character of two bytes
  CHECK(printable("\xFFp\xE4per\xE6\xB0") == "?p?per??");
}

}  // namespace text_tests
