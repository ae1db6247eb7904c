// std::from_chars and std::to_chars for floating-point numbers too, even where the standard library supports only
// integers: libc++ 14 lacks the former, Emscripten 3.1.6 both.
#pragma once

#include <charconv>
#include <concepts>
#include <string>

namespace calligraphy {

std::from_chars_result from_chars(const char* begin, const char* end, float& value) noexcept;
std::from_chars_result from_chars(const char* begin, const char* end, double& value) noexcept;

template <std::integral Integer>
std::from_chars_result from_chars(const char* begin, const char* end, Integer& value, int base = 10) noexcept {
  return std::from_chars(begin, end, value, base);
}

template <std::integral Integer>
std::to_chars_result to_chars(char* begin, char* end, Integer value, int base = 10) noexcept {
  return std::to_chars(begin, end, value, base);
}
/// Writes the shortest text that reads back as the same number.
std::to_chars_result to_chars(char* begin, char* end, float value) noexcept;
std::to_chars_result to_chars(char* begin, char* end, double value) noexcept;
/// Writes the number with this many decimal places.
std::to_chars_result to_chars_fixed(char* begin, char* end, double value, int places) noexcept;

/// Appends a finite number rounded to at most this many decimal places: no zeros at their end, no sign of a zero.
void append_rounded(std::string& text, double value, int places);

}  // namespace calligraphy
