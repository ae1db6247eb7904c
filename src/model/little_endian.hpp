// Numbers and bits as stored in a set file, least significant first on every processor.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/bit_cast.hpp"

namespace calligraphy {

template <class Unsigned>
Unsigned load(const std::byte* at) noexcept {
  Unsigned value = 0;
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
    value = static_cast<Unsigned>(value | static_cast<Unsigned>(static_cast<Unsigned>(at[i]) << (8 * i)));
  }
  return value;
}

template <class Unsigned>
void append(std::vector<std::byte>& bytes, Unsigned value) {
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) bytes.push_back(static_cast<std::byte>((value >> (8 * i)) & 0xFF));
}

/// `count` bits, 0 to 32, starting at bit `at`. Bits beyond the end are 0.
inline std::uint32_t load_bits(std::span<const std::byte> bytes, std::uint64_t at, int count) noexcept {
  const std::uint64_t mask = (std::uint64_t{1} << count) - 1;
  const std::uint64_t first = at / 8;
  if (bytes.size() >= 8 && first <= bytes.size() - 8) {
    return static_cast<std::uint32_t>((load<std::uint64_t>(bytes.data() + first) >> (at % 8)) & mask);
  }
  std::uint64_t value = 0;
  for (std::uint64_t i = first; i < bytes.size(); ++i) {
    value |= std::to_integer<std::uint64_t>(bytes[static_cast<std::size_t>(i)]) << (8 * (i - first));
  }
  return static_cast<std::uint32_t>((value >> (at % 8)) & mask);
}

/// A sequence of bits to write.
class BitWriter {
 public:
  /// Appends the `count` least significant bits of `value`, which must have no others set; 0 to 32.
  void write(std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i, ++size_) {
      if (size_ % 8 == 0) bytes_.push_back(std::byte{0});
      if (((value >> i) & 1) != 0) bytes_.back() |= std::byte{1} << (size_ % 8);
    }
  }
  void write_double(double value) {
    const auto whole = bit_cast<std::uint64_t>(value);
    write(whole & 0xFFFFFFFF, 32);
    write(whole >> 32, 32);
  }
  /// The bits so far, padded with zeros to a whole byte.
  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
  std::size_t size_ = 0;
};

}  // namespace calligraphy
