// Unpacks reports from transfers and packs commands into packets, by the framing of the profile.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "frame_field.hpp"
#include "packet_codec.hpp"
#include "serial_framing.hpp"

namespace calligraphy::phantom {

inline constexpr std::size_t max_framed_bytes = max_frame_bytes + 4;

class ReportFrames {
 public:
  /// The codec must outlive this.
  explicit ReportFrames(const PacketCodec& codec) noexcept
      : codec_(codec),
        is_serial_(codec.profile().framing == Framing::serial),
        serial_(SerialFrames::Expected{codec.profile().report_code,
                                       static_cast<std::uint8_t>(codec.profile().report_size)}) {}

  /// Calls `take(const RawSample&)` for each report. A stream has no short or overlong frames; an empty transfer is an
  /// empty frame with either framing.
  template <class Take>
  void feed(std::span<const std::byte> bytes, Take&& take) noexcept {
    if (!is_serial_ || bytes.empty()) {
      take(codec_.decode_report(bytes));
      return;
    }
    serial_.feed(bytes, [&](const SerialFrame& frame) { take(codec_.decode_report(frame.payload)); });
  }

  void reset() noexcept { serial_.reset(); }
  std::uint64_t skipped_bytes() const noexcept { return serial_.skipped(); }

  std::span<const std::byte> wrap(const RawCommand& command,
                                  std::span<std::byte, max_framed_bytes> packet) const noexcept {
    if (!is_serial_) return packet.first(codec_.encode_command(command, packet));
    std::array<std::byte, max_frame_bytes> payload;
    const std::size_t size = codec_.encode_command(command, payload);
    return packet.first(write_serial_frame(codec_.profile().command_code, std::span(payload).first(size), packet));
  }

  /// The packet of a start or stop command; in a stream its first byte is the code of the frame.
  std::span<const std::byte> wrap(std::span<const std::byte> bytes,
                                  std::span<std::byte, max_framed_bytes> packet) const noexcept {
    if (is_serial_) {
      return packet.first(write_serial_frame(std::to_integer<std::uint8_t>(bytes[0]), bytes.subspan(1), packet));
    }
    std::ranges::copy(bytes, packet.begin());
    return packet.first(bytes.size());
  }

 private:
  const PacketCodec& codec_;
  bool is_serial_;
  SerialFrames serial_;
};

}  // namespace calligraphy::phantom
