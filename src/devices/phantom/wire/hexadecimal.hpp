// Bytes as text, in the order of the bus: the ids 2988:0302 read "88 29 02 03".
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace calligraphy::phantom {

inline std::string hexadecimal(std::span<const std::byte> bytes) {
  constexpr char digits[] = "0123456789abcdef";
  std::string text;
  text.reserve(3 * bytes.size());
  for (const std::byte byte : bytes) {
    if (!text.empty()) text += ' ';
    text += digits[std::to_integer<unsigned>(byte) >> 4];
    text += digits[std::to_integer<unsigned>(byte) & 15u];
  }
  return text;
}

}  // namespace calligraphy::phantom
