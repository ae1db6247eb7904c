// The frames of a serial Touch, A5 5A command length payload, found in a stream of bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace calligraphy::phantom {

/// Read at the time of the call alone.
struct SerialFrame {
  std::uint8_t code = 0;
  std::span<const std::byte> payload;
};

/// Finds frames wherever a transfer begins or ends, in 259 bytes of memory. There is no checksum: what looks like a
/// header is one. So a reader that waits for one kind of frame names it, and any other header is passed over: garbage
/// between frames then costs nothing, a truncated frame at most the frame that it runs into. What such a mixed frame
/// holds is for the codec to refuse.
class SerialFrames {
 public:
  /// The one frame to be let through.
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
        ++frames_;
        size_ = 0;
      }
    }
  }

  /// Forgets a frame that has begun: the stream was interrupted.
  void reset() noexcept;

  std::uint64_t frames() const noexcept { return frames_; }
  /// Bytes that belong to no frame.
  std::uint64_t skipped() const noexcept { return skipped_; }

 private:
  static constexpr std::size_t header_size = 4;

  /// Whether a frame is complete.
  bool add(std::byte byte) noexcept;
  /// Drops bytes from the front until what is left may begin a frame.
  void resynchronise() noexcept;
  bool may_begin_frame() const noexcept;

  std::optional<Expected> expected_;
  std::array<std::byte, header_size + 255> frame_{};
  std::size_t size_ = 0;
  std::uint64_t frames_ = 0;
  std::uint64_t skipped_ = 0;
};

/// Writes the frame of a payload. The number of bytes; 0 when the payload is longer than 255 bytes or `frame` too
/// small.
std::size_t write_serial_frame(std::uint8_t code, std::span<const std::byte> payload,
                               std::span<std::byte> frame) noexcept;

}  // namespace calligraphy::phantom
