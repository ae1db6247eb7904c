// Properties of the serial framing that must hold for arbitrary bytes, however they are split.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "devices/phantom/wire/serial_framing.hpp"
#include "packet_codec.hpp"

namespace calligraphy_test {

/// The first byte determines how the rest is split, and whether one kind of frame is expected.
inline void try_serial_framing(std::span<const std::byte> input) {
  using namespace calligraphy::phantom;
  if (input.empty()) return;
  const auto choice = std::to_integer<unsigned>(input[0]);
  const std::span<const std::byte> stream = input.subspan(1);
  const auto expected = (choice & 1) != 0 ? std::optional(SerialFrames::Expected{4, 3}) : std::nullopt;
  const auto read = [&](std::size_t part) {
    SerialFrames frames(expected);
    std::vector<std::byte> seen;
    std::uint64_t in_frames = 0;
    for (std::size_t at = 0; at < stream.size(); at += part) {
      frames.feed(stream.subspan(at, std::min(part, stream.size() - at)), [&](const SerialFrame& frame) {
        claim(!expected || (frame.code == 4 && frame.payload.size() == 3));
        seen.push_back(std::byte{frame.code});
        seen.insert(seen.end(), frame.payload.begin(), frame.payload.end());
        in_frames += 4 + frame.payload.size();
      });
    }
    frames.reset();
    claim(in_frames + frames.skipped() == stream.size());  // no byte is lost or counted twice
    return seen;
  };
  claim(read(1 + choice / 2) == read(stream.size() + 1));  // how it is split makes no difference
}

}  // namespace calligraphy_test
