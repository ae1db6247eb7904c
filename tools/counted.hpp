// Numbers of things in reports.
#pragma once

#include <string>
#include <string_view>

#include <fmt/format.h>

namespace calligraphy::tools {

/// "1 stroke", "2 strokes", of a noun that takes an s.
template <typename Integer>
std::string counted(Integer count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace calligraphy::tools
