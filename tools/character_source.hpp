// Where characters come from: set files, files in the text format, the unpacked package hanzi-writer-data, or the
// built-in set.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/model/character_set.hpp>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace calligraphy::tools {

/// The files and directories of the option, the first over the others; without any the built-in set. Of a directory
/// only the characters of `text` are read. @throws Error naming the file
CharacterSet open_sources(const std::vector<std::string>& paths, const std::u32string& text);

/// The same, and each character of `text` is there in the order of this name, or without a name in any.
/// @throws Error naming the character or the file
CharacterSet open_characters(const std::vector<std::string>& paths, const std::u32string& text,
                             const std::string& order = {});

/// `text` in the order of this name, or without a name in the standard one or the first that there is.
std::vector<Character> characters_of(const CharacterSet& set, const std::u32string& text,
                                     const std::string& order = {});

/// --characters PATH, as often as wanted.
CLI::Option* add_characters_option(CLI::App& command, std::vector<std::string>& paths);

}  // namespace calligraphy::tools
