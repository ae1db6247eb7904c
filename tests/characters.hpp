// Built-in characters for tests.
#pragma once

#include <string_view>
#include <vector>

#include <calligraphy/base/text.hpp>
#include <calligraphy/model/character_list.hpp>

namespace calligraphy_test {

inline std::vector<calligraphy::Character> characters(std::string_view text) {
  std::vector<calligraphy::Character> found;
  for (const char32_t code : calligraphy::decode_utf8(text)) {
    found.push_back(*calligraphy::built_in_characters().find(code));
  }
  return found;
}

}  // namespace calligraphy_test
