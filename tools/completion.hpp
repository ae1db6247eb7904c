// Completion of command lines in shells.
#pragma once

#include <array>
#include <string>

#include "command_text.hpp"

namespace calligraphy::tools {

inline constexpr std::array shells = {"bash", "zsh", "fish"};

/// The script that teaches one of `shells` the commands, options and values of the program.
std::string completion(const CommandText& program, const std::string& shell);

}  // namespace calligraphy::tools
