// Names of code points for messages.
#pragma once

#include <string>

namespace calligraphy {

/// "U+5317".
std::string code_point_number(char32_t code);

/// "北 (U+5317)", or only the number if the code point is not a character or not printable.
std::string code_point_name(char32_t code);

}  // namespace calligraphy
