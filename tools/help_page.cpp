#include "help_page.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <system_error>

#include <fmt/format.h>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>

namespace calligraphy::tools {
namespace {

constexpr std::size_t narrowest = 40, widest = 100, usual = 80;
constexpr std::size_t names_width = 30;  ///< of the column of names, which starts with an indent
constexpr std::size_t indent = 2;

/// Columns that a text takes in a terminal.
std::size_t columns(const std::string& text) {
  if (!is_utf8(text)) return text.size();  // the name of a file
  constexpr char32_t first_wide = 0x1100;  // Hangul, kana, Chinese characters and their punctuation
  constexpr char32_t first_dash = 0x2000, last_sign = 0x2E7F;
  std::size_t count = 0;
  for (const char32_t code : decode_utf8(text)) {
    count += code < first_wide || (code >= first_dash && code <= last_sign) ? 1 : 2;
  }
  return count;
}

/// "  NAME       what it is".
std::string entry(const std::string& name, const std::string& description, std::size_t width) {
  const std::size_t margin = std::min(names_width, width / 3);
  const bool fits = indent + columns(name) + 2 <= margin;
  const std::string gap = fits ? std::string(margin - indent - columns(name), ' ') : "\n" + std::string(margin, ' ');
  return std::string(indent, ' ') + name + gap + wrapped(description, margin, margin, width);
}

std::string entry(const ArgumentText& argument, std::size_t width) {
  std::string description = argument.description;
  if (!argument.default_value.empty()) description += " (default: " + argument.default_value + ")";
  if (argument.required && argument.names.front().front() == '-') description += " (required)";
  return entry(signature(argument), description, width);
}

template <class List, class Entry>
std::string section(const char* title, const List& list, Entry entry_of) {
  if (list.empty()) return "";
  std::string text = fmt::format("\n{}:\n", title);
  for (const auto& each : list) text += entry_of(each);
  return text;
}

}  // namespace

std::string wrapped(const std::string& text, std::size_t at, std::size_t margin, std::size_t width) {
  std::string lines;
  std::istringstream words(text);
  bool begins_line = true;
  for (std::string word; words >> word; begins_line = false) {
    const std::size_t taken = columns(word);
    if (!begins_line && at + 1 + taken > width) {
      lines += "\n" + std::string(margin, ' ');
      at = margin;
      begins_line = true;
    }
    lines += (begins_line ? "" : " ") + word;
    at += taken + (begins_line ? 0 : 1);
  }
  return lines + "\n";
}

std::string help_page(const CommandText& command, std::size_t width) {
  const auto argument = [width](const ArgumentText& each) { return entry(each, width); };
  std::string text = wrapped(command.description, 0, 0, width);
  text += "\nUsage: " + wrapped(usage(command), 7, 9, width);
  text += section("Examples", command.examples, [](const std::string& line) { return "  " + line + "\n"; });
  text += section("Commands", command.commands,
                  [width](const CommandText& each) { return entry(own_name(each), summary(each.description), width); });
  text += section("Arguments", command.positional, argument);
  return text + section("Options", command.options, argument);
}

std::size_t help_width() {
  std::size_t width = 0;
  winsize size = {};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0) width = size.ws_col;
  const char* const environment = std::getenv("COLUMNS");
  if (width == 0 && environment != nullptr) {
    const char* const end = environment + std::strlen(environment);
    const auto [rest, failure] = std::from_chars(environment, end, width);
    if (failure != std::errc() || rest != end) width = 0;
  }
  return std::clamp(width == 0 ? usual : width, narrowest, widest);
}

}  // namespace calligraphy::tools
