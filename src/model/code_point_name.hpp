// Code points as messages name them.
#pragma once

#include <string>

namespace calligraphy {

/// "北 (U+5317)", and the number alone where the code point is no character or cannot be printed.
std::string code_point_name(char32_t code);

}  // namespace calligraphy
