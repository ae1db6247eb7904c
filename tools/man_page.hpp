// The manual page.
#pragma once

#include <string>

#include "command_text.hpp"

namespace calligraphy::tools {

/// calligraphy(1), for man(1): troff with the macros of man(7), in UTF-8.
std::string man_page(const CommandText& program, const std::string& version);

}  // namespace calligraphy::tools
