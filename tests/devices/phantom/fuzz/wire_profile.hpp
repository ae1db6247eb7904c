// Properties of the wire profile reader that must hold for arbitrary text.
#pragma once

#include <sstream>
#include <string>

#include <calligraphy/base/error.hpp>

#include "packet_codec.hpp"

namespace calligraphy_test {

inline void try_wire_profile(std::span<const std::byte> input) {
  using namespace calligraphy::phantom;
  std::string text;
  for (const std::byte byte : input) text += static_cast<char>(byte);
  std::istringstream in(text);
  try {
    const PacketCodec codec(read_wire_profile(in, "fuzz.txt"));  // a profile that is read is valid
    missing_for_force(codec.profile());
    // Each of its fields can be read and written in its frame.
    std::array<std::byte, max_frame_bytes> frame{};
    const std::span<std::byte> report = std::span(frame).first(codec.profile().report_size);
    for (const int byte : {0x00, 0xFF, 0xA5}) {
      std::ranges::fill(report, static_cast<std::byte>(byte));
      codec.decode_report(report);
    }
    claim(codec.encode_report({{1, -1, 1 << 20}, {}, ~0u, true, ~0u, {}}, frame) == codec.profile().report_size);
    claim(codec.encode_command({{1, -1, 1 << 20}, true, true, true, {}}, frame) == codec.profile().command_size);
    codec.decode_command(std::span(frame).first(codec.profile().command_size));
  } catch (const calligraphy::FormatError& error) {
    claim(std::string(error.what()).starts_with("fuzz.txt:"));
  }
}

}  // namespace calligraphy_test
