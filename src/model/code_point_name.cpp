#include "code_point_name.hpp"

#include <cstdio>

#include <calligraphy/base/text.hpp>

namespace calligraphy {

std::string code_point_number(char32_t code) {
  char number[16];
  std::snprintf(number, sizeof number, "U+%04X", static_cast<unsigned>(code));
  return number;
}

std::string code_point_name(char32_t code) {
  const std::string number = code_point_number(code);
  const bool is_control = code < 0x20 || (code >= 0x7F && code < 0xA0);
  const bool is_none = code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF);
  return is_control || is_none ? number : encode_utf8(code) + " (" + number + ")";
}

}  // namespace calligraphy
