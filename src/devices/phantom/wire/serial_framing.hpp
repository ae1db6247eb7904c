// Finds the frames of a serial Touch, A5 5A code length payload, in a stream of bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace calligraphy::phantom {

/// Valid only during the call.
struct SerialFrame {
  std::uint8_t code = 0;
  std::span<const std::byte> payload;
};

/// Finds frames regardless of transfer boundaries, in 259 bytes of memory. There is no checksum, so anything that looks
/// like a header is one. A reader that expects one kind of frame specifies it, and all other headers are skipped: then
/// garbage between frames costs nothing, and a truncated frame costs at most the frame after it. The codec must reject
/// the contents of such a mixed frame.
class SerialFrames {
 public:
  /// The only kind of frame to accept.
  struct Expected {
    std::uint8_t code = 0;
    std::uint8_t length = 0;
  };

  explicit SerialFrames(std::optional<Expected> expected = std::nullopt) noexcept : expected_(expected) {}

  /// Calls `take(const SerialFrame&)` for each frame that ends in these bytes.
  template <class Take>
  void feed(std::span<const std::byte> bytes, Take&& take) noexcept {
    for (const std::byte byte : bytes) {
      if (add(byte)) {
        take(SerialFrame{std::to_integer<std::uint8_t>(frame_[2]),
                         std::span<const std::byte>(frame_).subspan(header_size, size_ - header_size)});
        size_ = 0;
      }
    }
  }

  /// Discards an incomplete frame after the stream was interrupted.
  void reset() noexcept;

  /// Bytes that belong to no frame.
  std::uint64_t skipped() const noexcept { return skipped_; }

 private:
  static constexpr std::size_t header_size = 4;

  /// Whether a frame is complete.
  bool add(std::byte byte) noexcept;
  /// Drops bytes from the front until the rest may be the start of a frame.
  void resynchronise() noexcept;
  bool may_begin_frame() const noexcept;

  std::optional<Expected> expected_;
  std::array<std::byte, header_size + 255> frame_{};
  std::size_t size_ = 0;
  std::uint64_t skipped_ = 0;
};

/// Writes the frame of a payload. Returns the number of bytes; 0 if the payload is longer than 255 bytes or `frame` is
/// too small.
std::size_t write_serial_frame(std::uint8_t code, std::span<const std::byte> payload,
                               std::span<std::byte> frame) noexcept;

}  // namespace calligraphy::phantom
