// CRC-32, as used by zip and PNG.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace calligraphy {

std::uint32_t crc32(std::span<const std::byte> bytes) noexcept;

}  // namespace calligraphy
