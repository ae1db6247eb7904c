#include "order_name.hpp"

#include <algorithm>
#include <string>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>

namespace calligraphy {
namespace {

constexpr std::size_t longest = 255;

bool is_control(char c) noexcept { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

}  // namespace

bool is_order_name(std::string_view name) noexcept {
  return !name.empty() && name.size() <= longest && name.front() != ' ' && name.back() != ' ' &&
         std::none_of(name.begin(), name.end(), is_control) && name.find('#') == std::string_view::npos &&
         is_utf8(name);
}

void check_order_name(std::string_view name) {
  if (is_order_name(name)) return;
  throw ValueError(
      "'" + printable(name.substr(0, 60)) +
      "' is not a valid name of a stroke order: expected 1 to 255 bytes of UTF-8 without control characters, '#' and "
      "blanks at the ends");
}

}  // namespace calligraphy
