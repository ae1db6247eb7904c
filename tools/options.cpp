#include "options.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/model/typical_stroke.hpp>

#include "commands.hpp"

namespace calligraphy::tools {
namespace {

template <typename Number>
bool parse(const std::string& word, Number& value) {
  const char* const end = word.data() + word.size();
  const auto [rest, failure] = std::from_chars(word.data(), end, value);
  return failure == std::errc() && rest == end;
}

/// Typical strokes by their numbers, as in "5" or "1, 5, 38", also in full width; empty if the text is anything else.
/// @throws UsageError if there is no stroke of a number
std::vector<TextCharacter> numbered_strokes(const std::string& text) {
  std::vector<TextCharacter> strokes;
  if (!is_utf8(text)) return strokes;
  std::string words;
  for (char32_t code : decode_utf8(text)) {
    constexpr std::u32string_view separators = U" ,\t\n\u3000\uFF0C\u3001";
    if (code >= U'\uFF10' && code <= U'\uFF19') code = code - U'\uFF10' + U'0';
    const bool is_digit = code >= U'0' && code <= U'9';
    if (!is_digit && separators.find(code) == separators.npos) return strokes;
    words += is_digit ? static_cast<char>(code) : ' ';
  }
  std::istringstream in(words);
  for (std::string word; in >> word;) {
    int id = 0;
    if (!parse(word, id) || id < 1 || id > typical_stroke_count) {
      throw UsageError(fmt::format("TEXT: {}: the typical strokes have the numbers 1 to {}", word, typical_stroke_count));
    }
    strokes.push_back({typical_stroke_code(id), typical_stroke_code(id), 0});
  }
  return strokes;
}

}  // namespace

CLI::Validator number(double least, double most) {
  const auto check = [least, most](std::string& word) {
    double value = 0.0;
    if (parse(word, value) && value >= least && value <= most) return std::string();
    return fmt::format("{}: expected a number from {} to {}", word, least, most);
  };
  return CLI::Validator(check, "NUMBER");
}

CLI::Validator integer(unsigned long long least, unsigned long long most) {
  const auto check = [least, most](std::string& word) {
    unsigned long long value = 0;
    if (parse(word, value) && value >= least && value <= most) return std::string();
    return fmt::format("{}: expected an integer from {} to {}", word, least, most);
  };
  return CLI::Validator(check, "INTEGER");
}

std::vector<TextCharacter> characters_of(const std::string& text) {
  std::vector<TextCharacter> characters = numbered_strokes(text);
  if (!characters.empty()) return characters;
  try {
    characters = text_characters(text);
  } catch (const FormatError& error) {
    throw UsageError(std::string("TEXT: ") + error.what());
  }
  if (characters.empty()) throw UsageError(fmt::format("TEXT: \"{}\" contains no characters", text));
  return characters;
}

std::u32string codes_of(const std::vector<TextCharacter>& text) {
  std::u32string codes;
  for (const TextCharacter& character : text) {
    if (codes.find(character.written) == codes.npos) codes += character.written;
  }
  return codes;
}

std::string character_label(char32_t code) {
  const std::string number = fmt::format("U+{:04X}", static_cast<unsigned>(code));
  const bool is_control = code < 0x20 || (code >= 0x7F && code < 0xA0);
  return is_control ? number : fmt::format("{} ({})", encode_utf8(code), number);
}

std::string name_in_file(char32_t code) {
  constexpr std::string_view plain = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
  const bool good = code >= 0xA0 || plain.find(static_cast<char>(code)) != std::string_view::npos;
  return good ? encode_utf8(code) : fmt::format("U+{:04X}", static_cast<unsigned>(code));
}

void add_language_option(CLI::App& command, Language& language) {
  std::vector<std::string> codes, names;
  for (const Language& each : languages()) {
    codes.emplace_back(each.code());
    names.emplace_back(each.name());
  }
  command
      .add_option_function<std::string>(
          "--language",
          [&language](const std::string& code) { language = Language(code); },
          fmt::format("Language of remarks, tables, pictures and hints: {}", fmt::join(names, ", ")))
      ->check(CLI::IsMember(codes))
      ->default_str("en");
}

void add_lines_flag(CLI::App& command, StrokeStyle& style) {
  command
      .add_flag_callback(
          "--lines", [&style] { style = StrokeStyle::lines; }, "Draw strokes as lines of one width instead of ink")
      ->disable_flag_override();
}

void add_page_options(CLI::App& command, PageChoice& page) {
  command.add_option("--page", page.plane, "Page upright in front of the user, or flat on the desk")
      ->check(CLI::IsMember({"upright", "desk"}))
      ->capture_default_str();
  command
      .add_option(
          "--motion-scale", page.scale,
          "The pen on the page moves K times as far as the hand, which feels K^2 times its stiffness; 0.1 to 10")
      ->check(number(0.1, 10.0))
      ->capture_default_str()
      ->type_name("K");
}

CLI::Validator such_as(const std::vector<std::string>& values) {
  return CLI::Validator([](std::string&) { return std::string(); }, fmt::format("{{{},...}}", fmt::join(values, ",")));
}

std::vector<std::string> profile_names() {
  std::vector<std::string> names;
  for (const Capabilities& profile : device_profiles()) names.push_back(profile.name);
  return names;
}

std::vector<std::string> simulated_devices() {
  std::vector<std::string> devices = profile_names();
  for (const std::string& name : profile_names()) devices.push_back("simulated:" + name);
  return devices;
}

std::string device_names() { return fmt::format("{}", fmt::join(profile_names(), ", ")); }

CLI::Option* add_device_option(CLI::App& command, std::string& device) {
  return command.add_option("--device", device, "[simulated:]NAME, where NAME is one of " + device_names())
      ->capture_default_str()
      ->check(such_as(simulated_devices()))
      ->type_name("DEVICE");
}

Capabilities chosen_device(const std::string& device, const char* option) {
  const std::string kind = "simulated:";
  const std::string name = device.rfind(kind, 0) == 0 ? device.substr(kind.size()) : device;
  for (const Capabilities& profile : device_profiles()) {
    if (profile.name == name) return profile;
  }
  throw UsageError(
      fmt::format("{}: {}: expected [simulated:]NAME, where NAME is one of {}", option, device, device_names()));
}

}  // namespace calligraphy::tools
