// Hands the newest packet from one thread to another, wait-free on both sides; an older one not yet taken is dropped.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

namespace calligraphy::phantom {

/// Longer than any packet of a full-speed device, with a margin for unknown ones.
constexpr std::size_t max_packet_bytes = 512;

struct Packet {
  std::array<std::byte, max_packet_bytes> bytes = {};
  std::size_t size = 0;

  std::span<const std::byte> content() const noexcept { return {bytes.data(), size}; }
  void assign(std::span<const std::byte> from) noexcept {
    size = std::min(from.size(), bytes.size());
    std::copy_n(from.begin(), size, bytes.begin());
  }
};

/// A triple buffer: the writer fills its own packet, then exchanges it for the middle one; the reader does the same if
/// the middle one is fresh. One thread may put, one may take.
class NewestPacket {
 public:
  /// Returns true if it replaced a packet not yet taken. Truncates a packet longer than max_packet_bytes.
  bool put(std::span<const std::byte> packet) noexcept {
    packets_[writing_].assign(packet);
    const std::uint8_t before =
        middle_.exchange(static_cast<std::uint8_t>(writing_ | fresh), std::memory_order_acq_rel);
    writing_ = before & index;
    return (before & fresh) != 0;
  }

  bool waiting() const noexcept { return (middle_.load(std::memory_order_acquire) & fresh) != 0; }

  /// The newest packet, valid until the next call; null if there is none since the last call.
  const Packet* take() noexcept {
    if (!waiting()) return nullptr;
    reading_ = middle_.exchange(reading_, std::memory_order_acq_rel) & index;
    return &packets_[reading_];
  }

 private:
  static constexpr std::uint8_t fresh = 4;
  static constexpr std::uint8_t index = 3;

  std::array<Packet, 3> packets_;
  std::uint8_t writing_ = 0;
  std::atomic<std::uint8_t> middle_{1};
  std::uint8_t reading_ = 2;
};

}  // namespace calligraphy::phantom
