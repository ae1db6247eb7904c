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

/// Opens the files and directories in `paths`, layered with the first on top; without any, the built-in set. From a
/// directory, only the characters of `text` are read. @throws Error naming the file
CharacterSet open_sources(const std::vector<std::string>& paths, const std::u32string& text);

/// As open_sources(), and checks that the set has every character of `text` in the stroke order `order`, or in any
/// order if that is empty. @throws Error naming the character or the file
CharacterSet open_characters(const std::vector<std::string>& paths, const std::u32string& text,
                             const std::string& order = {});

/// The characters of `text` in the stroke order `order`; if that is empty, in the standard or else the first order.
std::vector<Character> characters_of(const CharacterSet& set, const std::u32string& text,
                                     const std::string& order = {});

/// Adds --characters PATH, which may be repeated.
CLI::Option* add_characters_option(CLI::App& command, std::vector<std::string>& paths);

}  // namespace calligraphy::tools
