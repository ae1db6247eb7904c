#include "charconv.hpp"

#ifdef __cpp_lib_to_chars  // floating-point numbers, too
namespace library = std;
#else
#include "charconv_by_libc.hpp"
namespace library = calligraphy::by_libc;
#endif

namespace calligraphy {

std::from_chars_result from_chars(const char* begin, const char* end, float& value) noexcept {
  return library::from_chars(begin, end, value);
}
std::from_chars_result from_chars(const char* begin, const char* end, double& value) noexcept {
  return library::from_chars(begin, end, value);
}
std::to_chars_result to_chars(char* begin, char* end, float value) noexcept {
  return library::to_chars(begin, end, value);
}
std::to_chars_result to_chars(char* begin, char* end, double value) noexcept {
  return library::to_chars(begin, end, value);
}
std::to_chars_result to_chars_fixed(char* begin, char* end, double value, int places) noexcept {
#ifdef __cpp_lib_to_chars
  return std::to_chars(begin, end, value, std::chars_format::fixed, places);
#else
  return by_libc::to_chars_fixed(begin, end, value, places);
#endif
}

void append_rounded(std::string& text, double value, int places) {
  char buffer[512];  // the longest number, and more
  const char* end = to_chars_fixed(buffer, buffer + sizeof buffer, value, places).ptr;
  if (places > 0) {
    while (end[-1] == '0') --end;
    if (end[-1] == '.') --end;
  }
  const std::string_view digits(buffer, static_cast<std::size_t>(end - buffer));
  text += digits == "-0" ? "0" : digits;
}

}  // namespace calligraphy
