#include "from_chars.hpp"

#ifdef __cpp_lib_to_chars  // of floating-point numbers, too

namespace calligraphy {

std::from_chars_result from_chars(const char* begin, const char* end, float& value) noexcept {
  return std::from_chars(begin, end, value);
}

std::from_chars_result from_chars(const char* begin, const char* end, double& value) noexcept {
  return std::from_chars(begin, end, value);
}

}  // namespace calligraphy

#else

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <string_view>

#include <locale.h>
#ifdef __APPLE__
#include <xlocale.h>
#endif

namespace calligraphy {
namespace {

/// strtod takes what from_chars does not: white space and a plus in front, and hexadecimal digits.
std::string_view decimal(std::string_view text) {
  const std::size_t sign = !text.empty() && text[0] == '-' ? 1 : 0;
  constexpr std::string_view first = "0123456789.iInN";
  if (text.size() <= sign || first.find(text[sign]) == std::string_view::npos) return {};
  const std::size_t size = text.find_first_not_of("0123456789.+-eEinftyaINFTYA");
  return text.substr(0, size);
}

bool has_digit_above_zero(std::string_view number) {
  return number.substr(0, number.find_first_of("eE")).find_first_of("123456789") != std::string_view::npos;
}

template <typename Number, typename Convert>
std::from_chars_result convert(const char* begin, const char* end, Number& value, const Convert& to_number) {
  static const locale_t c = newlocale(LC_ALL_MASK, "C", nullptr);
  const std::string text(decimal({begin, static_cast<std::size_t>(end - begin)}));
  char* rest = nullptr;
  const Number found = to_number(text.c_str(), &rest, c);
  const auto size = static_cast<std::size_t>(rest - text.c_str());
  if (size == 0) return {begin, std::errc::invalid_argument};
  const bool is_number = has_digit_above_zero(std::string_view(text).substr(0, size));
  const bool in_range = !is_number || (std::isfinite(found) && found != Number(0));
  if (in_range) value = found;
  return {begin + size, in_range ? std::errc() : std::errc::result_out_of_range};
}

}  // namespace

std::from_chars_result from_chars(const char* begin, const char* end, float& value) noexcept {
  return convert(begin, end, value, strtof_l);
}

std::from_chars_result from_chars(const char* begin, const char* end, double& value) noexcept {
  return convert(begin, end, value, strtod_l);
}

}  // namespace calligraphy

#endif
