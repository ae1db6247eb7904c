// Properties of the packet codec that must hold for arbitrary bytes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>

#include "devices/phantom/wire/frame_field.hpp"
#include "devices/phantom/wire/packet_codec.hpp"

namespace calligraphy_test {

/// Aborts the program if a claim does not hold, which both a fuzzer and a test detect.
inline void claim(bool holds) {
  if (!holds) std::abort();
}

/// The first byte selects the profile and the direction, the rest is the frame.
inline void try_packet_codec(std::span<const std::byte> input) {
  using namespace calligraphy::phantom;
  static const std::array<PacketCodec, 2> codecs = {PacketCodec(wire_profile("omni")),
                                                    PacketCodec(wire_profile("simulated"))};
  if (input.empty()) return;
  const auto choice = std::to_integer<unsigned>(input[0]);
  const PacketCodec& codec = codecs[choice % 2];
  const std::span<const std::byte> frame = input.subspan(1);
  std::array<std::byte, max_frame_bytes> again{};
  if ((choice & 2) != 0) {
    const RawSample sample = codec.decode_report(frame);
    claim(is_readable(sample.fault) ==
          (sample.fault != calligraphy::DeviceFault::corrupted_frame && frame.size() == codec.profile().report_size));
    if (!is_readable(sample.fault)) return;
    for (const std::int64_t count : sample.encoders) claim(count >= 0 && count <= 0xFFFF);
    const std::size_t size = codec.encode_report(sample, again);
    const RawSample back = codec.decode_report(std::span(again).first(size));
    claim(back.encoders == sample.encoders && back.gimbal == sample.gimbal && back.buttons == sample.buttons &&
          back.docked == sample.docked && back.sequence == sample.sequence && back.fault == sample.fault);
  } else {
    const RawCommand command = codec.decode_command(frame);
    if (command.fault != calligraphy::DeviceFault::none) return;
    const std::size_t size = codec.encode_command(command, again);
    const RawCommand back = codec.decode_command(std::span(again).first(size));
    // The single count that exists in only one direction is clamped.
    for (std::size_t i = 0; i < 3; ++i) claim(back.torque[i] == command.torque[i] || command.torque[i] == 2048);
    claim(back.motors_on == command.motors_on && back.toggle == command.toggle);
  }
}

}  // namespace calligraphy_test
