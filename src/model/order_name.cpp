#include "order_name.hpp"

#include <algorithm>
#include <string>

#include <calligraphy/error.hpp>
#include <calligraphy/model/text.hpp>

namespace calligraphy {
namespace {

constexpr std::size_t longest = 255;

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

bool is_fit(std::string_view name) {
  if (name.empty() || name.size() > longest || name.front() == ' ' || name.back() == ' ') return false;
  if (std::any_of(name.begin(), name.end(), is_control) || name.find('#') != std::string_view::npos) return false;
  try {
    decode_utf8(name);
  } catch (const FormatError&) {
    return false;
  }
  return true;
}

}  // namespace

void check_order_name(std::string_view name) {
  if (is_fit(name)) return;
  std::string quoted(name.substr(0, 60));
  std::replace_if(quoted.begin(), quoted.end(), is_control, '?');
  throw ValueError("'" + quoted +
                   "' is no name of a stroke order: 1 to 255 bytes of UTF-8, without control characters, '#' and "
                   "blanks at its ends");
}

}  // namespace calligraphy
