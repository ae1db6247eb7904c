// Words of a command line that no command knows.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "command_text.hpp"
#include "commands.hpp"

namespace calligraphy::tools {

/// The candidate that `word` was probably meant to be: at most two slips of the keyboard away (one in a short word), or
/// the only one that begins with it. Empty: none.
std::string nearest_name(const std::string& word, const std::vector<std::string>& candidates);

/// Looks through the words after the program's name for a command or an option that there is not, an option without its
/// value or given twice, and an argument too many. What follows --help or --version does not count.
/// @throws UsageError naming the first one, and the name that is near
void check_words(const CommandText& program, std::span<const char* const> words);

/// The command of this name below `command`. @throws UsageError as above
const CommandText& chosen_command(const CommandText& command, const std::string& name);

/// Of an argument too many.
UsageError unexpected(const std::string& argument);

}  // namespace calligraphy::tools
