// Help for a terminal.
#pragma once

#include <cstddef>
#include <string>

#include "command_text.hpp"

namespace calligraphy::tools {

/// Lines of at most `width` columns, of which a Chinese character takes two. Examples are not wrapped.
std::string help_page(const CommandText& command, std::size_t width);

/// Words from column `at` on, in lines of at most `width` columns, of which further ones begin at column `margin`. Ends
/// with a line feed.
std::string wrapped(const std::string& text, std::size_t at, std::size_t margin, std::size_t width);

/// Of the terminal on standard output, at most 100, which is as wide as prose reads well; 80 without a terminal, unless
/// the environment variable COLUMNS says otherwise.
std::size_t help_width();

}  // namespace calligraphy::tools
