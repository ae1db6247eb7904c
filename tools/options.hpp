// Validated command-line arguments.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/judge/language.hpp>
#include <calligraphy/model/character_text.hpp>
#include <calligraphy/pictures/stroke_style.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/render/motion_mapping.hpp>

namespace calligraphy::tools {

/// Accepts an argument that is entirely a number in [least, most]; rejects "1e999", "nan", "0x10" and "5 ".
CLI::Validator number(double least, double most);

/// Accepts an argument that is entirely an integer in [least, most].
CLI::Validator integer(unsigned long long least, unsigned long long most);

/// As text_characters(), or typical strokes by their numbers. @throws UsageError if the text is not UTF-8 or has no characters
std::vector<TextCharacter> characters_of(const std::string& text);

/// Their code points as written, each once; import_characters() also takes what they mean.
std::u32string codes_of(const std::vector<TextCharacter>& text);

/// "北 (U+5317)", or only the code if the character is not printable.
std::string character_label(char32_t code);

/// The character, or "U+002F" if it is unsuitable for a file name.
std::string name_in_file(char32_t code);

/// Accepts everything; completion offers these values.
CLI::Validator such_as(const std::vector<std::string>& values);

/// Adds --device [simulated:]NAME, whose default is the initial value of `device`.
CLI::Option* add_device_option(CLI::App& command, std::string& device);

/// How the page lies in the workspace of a device.
struct PageChoice {
  std::string plane = "upright";
  double scale = 1.0;  ///< K_S

  MotionMapping mapping(double width, double height) const {
    return plane == "desk" ? desk_page(width, height, scale) : upright_page(width, height, scale);
  }
  PageLayout layout(const Capabilities& device) const { return workspace_layout(device, mapping(0.0, 0.0)); }
};

/// Adds --language, that of what people are told.
void add_language_option(CLI::App& command, Language& language);

/// Adds --lines, which draws strokes as lines instead of ink.
void add_lines_flag(CLI::App& command, StrokeStyle& style);

/// Adds --page upright|desk and --motion-scale K.
void add_page_options(CLI::App& command, PageChoice& page);

/// Names of all device profiles.
std::vector<std::string> profile_names();
/// What --device takes: each of them, and again with "simulated:" before it.
std::vector<std::string> simulated_devices();
/// The same as in "desktop, ideal".
std::string device_names();

/// The profile named by --device. @throws UsageError listing the available ones
Capabilities chosen_device(const std::string& device, const char* option = "--device");

}  // namespace calligraphy::tools
