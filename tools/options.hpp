// What a person typed, checked.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include <calligraphy/devices/capabilities.hpp>

namespace calligraphy::tools {

/// A whole word that is a number in [least, most]; "1e999", "nan", "0x10" and "5 " are none.
CLI::Validator number(double least, double most);

/// A whole word that is an integer in [least, most].
CLI::Validator integer(unsigned long long least, unsigned long long most);

/// The characters of a text without its white space. @throws UsageError when it is not UTF-8 or nothing remains
std::u32string characters_of(const std::string& text);

/// "北 (U+5317)", and the code alone where the character cannot be printed.
std::string name_of(char32_t code);

/// The character, or "U+002F" where it is no good in a file name.
std::string name_in_file(char32_t code);

/// --device [simulated:]NAME, the desktop unless told otherwise.
CLI::Option* add_device_option(CLI::App& command, std::string& device);

/// "desktop, ideal, ...": the profiles by name.
std::string device_names();

/// The profile that --device names. @throws UsageError naming those that there are
Capabilities chosen_device(const std::string& device, const char* option = "--device");

}  // namespace calligraphy::tools
