// What a person typed, checked.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace calligraphy::tools {

/// A whole word that is a number in [least, most]; "1e999", "nan", "0x10" and "5 " are none.
CLI::Validator number(double least, double most);

/// A whole word that is an integer in [least, most].
CLI::Validator integer(unsigned long long least, unsigned long long most);

/// The characters of a text without its white space. @throws UsageError when it is not UTF-8 or nothing remains
std::u32string characters_of(const std::string& text);

/// "北 (U+5317)", and the code alone where the character cannot be printed.
std::string name_of(char32_t code);

}  // namespace calligraphy::tools
