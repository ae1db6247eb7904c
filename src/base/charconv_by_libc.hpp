// Converts between numbers and text with strtod and snprintf, by the rules of <charconv>.
#pragma once

#include <locale.h>
#ifdef __APPLE__
#include <xlocale.h>
#endif

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>

namespace calligraphy::by_libc {

/// While it lives, this thread's decimal separator is a point.
class PlainLocale {
 public:
  PlainLocale() {
    static const locale_t plain = newlocale(LC_ALL_MASK, "C", nullptr);
    before_ = uselocale(plain);
  }
  ~PlainLocale() { uselocale(before_); }
  PlainLocale(const PlainLocale&) = delete;
  PlainLocale& operator=(const PlainLocale&) = delete;

 private:
  locale_t before_;
};

/// The leading part that can be a decimal number; strtod would accept white space, a plus sign and hexadecimal digits,
/// too.
inline std::string_view decimal(std::string_view text) {
  const std::size_t sign = !text.empty() && text[0] == '-' ? 1 : 0;
  constexpr std::string_view first = "0123456789.iInN";
  if (text.size() <= sign || first.find(text[sign]) == std::string_view::npos) return {};
  return text.substr(0, text.find_first_not_of("0123456789.+-eEinftyaINFTYA"));
}

/// Zero and explicit infinity are in range; a number that rounds to zero or overflows to infinity is not.
template <typename Number>
bool in_range(std::string_view text, Number value) {
  const std::string_view digits = text.substr(0, text.find_first_of("eE"));
  const bool above_zero = digits.find_first_of("123456789") != std::string_view::npos;
  return !above_zero || (std::isfinite(value) && value != Number(0));
}

template <typename Number>
std::from_chars_result from_chars(const char* begin, const char* end, Number& value) {
  const std::string text(decimal({begin, static_cast<std::size_t>(end - begin)}));
  const PlainLocale locale;
  char* rest = nullptr;
  Number found;
  if constexpr (std::is_same_v<Number, float>) {
    found = std::strtof(text.c_str(), &rest);
  } else {
    found = std::strtod(text.c_str(), &rest);
  }
  const auto size = static_cast<std::size_t>(rest - text.c_str());
  if (size == 0) return {begin, std::errc::invalid_argument};
  if (!in_range(std::string_view(text).substr(0, size), found)) return {begin + size, std::errc::result_out_of_range};
  value = found;
  return {begin + size, std::errc()};
}

inline std::to_chars_result copied(const std::string& text, char* begin, char* end) {
  if (text.size() > static_cast<std::size_t>(end - begin)) return {end, std::errc::value_too_large};
  return {std::copy(text.begin(), text.end(), begin), std::errc()};
}

inline std::string printed(const char* format, int places, double value) {
  const PlainLocale locale;
  char text[400];  // the largest number has 309 digits before its point
  return {text, static_cast<std::size_t>(std::snprintf(text, sizeof text, format, places, value))};
}

/// The shorter of the fixed and the scientific notation with the fewest digits that read back the same.
template <typename Number>
std::to_chars_result to_chars(char* begin, char* end, Number value) {
  if (!std::isfinite(value)) {
    const std::string text = std::isnan(value) ? "nan" : "inf";
    return copied(std::signbit(value) ? '-' + text : text, begin, end);
  }
  std::string scientific;
  for (int places = 0; places < std::numeric_limits<Number>::max_digits10; ++places) {
    scientific = printed("%.*e", places, static_cast<double>(value));
    Number back = 0;
    by_libc::from_chars(scientific.data(), scientific.data() + scientific.size(), back);
    if (back == value) break;
  }
  const std::size_t e = scientific.find('e');
  const int exponent = std::atoi(scientific.c_str() + e + 1);
  const std::size_t sign = scientific[0] == '-' ? 1 : 0;
  const int digits = static_cast<int>(e - sign) - (e - sign > 1 ? 1 : 0);  // the point is not a digit
  const std::string fixed = printed("%.*f", std::max(digits - 1 - exponent, 0), static_cast<double>(value));
  return copied(fixed.size() <= scientific.size() ? fixed : scientific, begin, end);
}

inline std::to_chars_result to_chars_fixed(char* begin, char* end, double value, int places) {
  return copied(printed("%.*f", places, value), begin, end);
}

}  // namespace calligraphy::by_libc
