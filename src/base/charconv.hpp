// std::from_chars and std::to_chars of every number, also with a standard library that has them for integers alone:
// libc++ 14 lacks the first, Emscripten 3.1.6 both.
#pragma once

#include <charconv>
#include <concepts>

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
/// The shortest text that reads back the same.
std::to_chars_result to_chars(char* begin, char* end, float value) noexcept;
std::to_chars_result to_chars(char* begin, char* end, double value) noexcept;
/// With so many decimal places.
std::to_chars_result to_chars_fixed(char* begin, char* end, double value, int places) noexcept;

}  // namespace calligraphy
