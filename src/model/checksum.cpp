#include "checksum.hpp"

#include <array>

#include "little_endian.hpp"

namespace calligraphy {
namespace {

constexpr int slices = 8;  // bytes per step

using Table = std::array<std::uint32_t, 256>;

/// tables[k][b]: the register, initially zero, after byte b and k zero bytes.
constexpr std::array<Table, slices> make_tables() {
  constexpr std::uint32_t polynomial = 0xEDB88320;
  std::array<Table, slices> tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t value = byte;
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1) ^ ((value & 1) != 0 ? polynomial : 0);
    tables[0][byte] = value;
  }
  for (std::size_t k = 1; k < slices; ++k) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t before = tables[k - 1][byte];
      tables[k][byte] = (before >> 8) ^ tables[0][before & 0xFF];
    }
  }
  return tables;
}

constexpr std::array<Table, slices> tables = make_tables();

}  // namespace

std::uint32_t crc32(std::span<const std::byte> bytes) noexcept {
  std::uint32_t crc = 0xFFFFFFFF;
  for (; bytes.size() >= slices; bytes = bytes.subspan(slices)) {
    const std::uint64_t eight = load<std::uint64_t>(bytes.data()) ^ crc;
    crc = 0;
    for (int k = 0; k < slices; ++k) crc ^= tables[static_cast<std::size_t>(slices - 1 - k)][(eight >> (8 * k)) & 0xFF];
  }
  for (const std::byte byte : bytes) crc = (crc >> 8) ^ tables[0][(crc ^ static_cast<std::uint32_t>(byte)) & 0xFF];
  return ~crc;
}

}  // namespace calligraphy
