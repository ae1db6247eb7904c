// Reads and writes a field of a frame, from the same description.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include <calligraphy/devices/phantom/wire_profile.hpp>

namespace calligraphy::phantom {

/// In either direction, without framing [bytes].
inline constexpr std::size_t max_frame_bytes = 512;

inline std::uint32_t field_mask(const Field& field) noexcept {
  return field.bits >= 32 ? ~std::uint32_t{0} : (std::uint32_t{1} << field.bits) - 1;
}

/// Minimum and maximum value.
inline std::pair<std::int64_t, std::int64_t> range(const Field& field) noexcept {
  const std::int64_t values = std::int64_t{1} << field.bits;
  if (field.is_signed) return {-values / 2, values / 2 - 1};
  return {0, values - 1};
}

/// Torque that a DAC can output in both directions [counts].
inline std::int64_t torque_range(const DacField& dac) noexcept {
  const auto [least, most] = range(dac.field);
  return std::min(dac.zero - least, most - dac.zero);
}

/// The integer that contains the field. validate() has checked that the field lies in the frame.
inline std::uint32_t read_integer(const Field& field, std::span<const std::byte> frame) noexcept {
  std::uint32_t value = 0;
  for (int i = 0; i < field.bytes; ++i) {
    const int place = field.big_endian ? i : field.bytes - 1 - i;
    value = value << 8 | std::to_integer<std::uint32_t>(frame[static_cast<std::size_t>(field.offset + place)]);
  }
  return value;
}

inline std::int64_t read_field(const Field& field, std::span<const std::byte> frame) noexcept {
  std::uint32_t value = read_integer(field, frame) >> field.low_bit;
  if (field.inverted) value = ~value;
  value &= field_mask(field);
  const std::int64_t sign = std::int64_t{1} << (field.bits - 1);
  if (field.is_signed && value >= static_cast<std::uint64_t>(sign)) return std::int64_t{value} - 2 * sign;
  return value;
}

/// Writes the lowest bits of the value and leaves all other bits of the frame unchanged.
inline void write_field(const Field& field, std::int64_t number, std::span<std::byte> frame) noexcept {
  const std::uint32_t mask = field_mask(field);
  std::uint32_t value = static_cast<std::uint32_t>(static_cast<std::uint64_t>(number)) & mask;
  if (field.inverted) value = ~value & mask;
  std::uint32_t integer = (read_integer(field, frame) & ~(mask << field.low_bit)) | value << field.low_bit;
  for (int i = 0; i < field.bytes; ++i) {
    const int place = field.big_endian ? field.bytes - 1 - i : i;
    frame[static_cast<std::size_t>(field.offset + place)] = static_cast<std::byte>(integer & 0xFF);
    integer >>= 8;
  }
}

}  // namespace calligraphy::phantom
