// Heads of tables in the language of the person who reads them.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

#include <fmt/args.h>
#include <fmt/format.h>

#include <calligraphy/judge/language.hpp>

namespace calligraphy::tools {

/// The two lines of a head whose columns have the texts of these keys; a column without a key has none. `line` is the
/// format of a line of the table, in which each of them is a string.
inline std::string table_head(const char* line, const Language& language,
                              std::initializer_list<std::string_view> keys) {
  fmt::dynamic_format_arg_store<fmt::format_context> above, below;
  for (const std::string_view key : keys) {
    const std::string text = language.text(key);
    const std::size_t bar = text.find('|');
    above.push_back(text.substr(0, bar));
    below.push_back(bar == text.npos ? std::string() : text.substr(bar + 1));
  }
  return fmt::vformat(line, above) + fmt::vformat(line, below);
}

}  // namespace calligraphy::tools
