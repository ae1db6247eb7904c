// std::from_chars for every number, also with a standard library that has it for integers alone: libc++ before 20.
#pragma once

#include <charconv>
#include <type_traits>

namespace calligraphy {

std::from_chars_result from_chars(const char* begin, const char* end, float& value) noexcept;
std::from_chars_result from_chars(const char* begin, const char* end, double& value) noexcept;

template <typename Integer>
  requires std::is_integral_v<Integer>
std::from_chars_result from_chars(const char* begin, const char* end, Integer& value, int base = 10) noexcept {
  return std::from_chars(begin, end, value, base);
}

}  // namespace calligraphy
