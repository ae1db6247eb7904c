#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "devices/phantom/wire/serial_framing.hpp"

#include "../../allocation_counter.hpp"
#include "../../catch.hpp"

using namespace calligraphy::phantom;

namespace {

using Bytes = std::vector<std::byte>;

Bytes frame_bytes(std::initializer_list<int> values) {
  Bytes result;
  for (const int value : values) result.push_back(static_cast<std::byte>(value));
  return result;
}

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

struct Seen {
  std::uint8_t code;
  Bytes payload;
  bool operator==(const Seen&) const = default;
};

std::vector<Seen> feed(SerialFrames& frames, const Bytes& stream, std::size_t part = 1'000'000) {
  std::vector<Seen> seen;
  for (std::size_t i = 0; i < stream.size(); i += part) {
    frames.feed(std::span(stream).subspan(i, std::min(part, stream.size() - i)), [&](const SerialFrame& frame) {
      seen.push_back({frame.code, Bytes(frame.payload.begin(), frame.payload.end())});
    });
  }
  return seen;
}

std::vector<Seen> seen_in(const Bytes& stream, std::size_t part = 1'000'000) {
  SerialFrames frames;
  return feed(frames, stream, part);
}

const Bytes frame_a = frame_bytes({0xA5, 0x5A, 0x04, 0x03, 1, 2, 3});
const Bytes frame_b = frame_bytes({0xA5, 0x5A, 0x0C, 0x01, 9});
const Bytes frame_empty = frame_bytes({0xA5, 0x5A, 0x0F, 0x00});
const Seen seen_a{0x04, frame_bytes({1, 2, 3})};
const Seen seen_b{0x0C, frame_bytes({9})};
const Seen seen_empty{0x0F, {}};

}  // namespace

TEST_CASE("frames are found however the transfers split them", "[phantom][framing]") {
  const Bytes stream = frame_a + frame_b + frame_empty + frame_a;
  for (std::size_t part = 1; part <= stream.size(); ++part) {
    CAPTURE(part);
    REQUIRE(seen_in(stream, part) == std::vector<Seen>{seen_a, seen_b, seen_empty, seen_a});
  }
}

TEST_CASE("garbage between frames is skipped and counted", "[phantom][framing]") {
  SerialFrames frames;
  CHECK(feed(frames, frame_bytes({0, 0xFF, 0x5A}) + frame_a + frame_bytes({7, 7}) + frame_b) == std::vector<Seen>{seen_a, seen_b});
  CHECK(frames.skipped() == 5);
}

TEST_CASE("a stray first marker byte before a frame is not mistaken for the frame's own", "[phantom][framing]") {
  CHECK(seen_in(frame_bytes({0xA5}) + frame_a) == std::vector<Seen>{seen_a});
  CHECK(seen_in(frame_bytes({0xA5, 0xA5, 0xA5}) + frame_a) == std::vector<Seen>{seen_a});
  CHECK(seen_in(frame_bytes({0xA5, 0x00}) + frame_a) == std::vector<Seen>{seen_a});
}

TEST_CASE("markers inside a payload start no frame", "[phantom][framing]") {
  const Bytes payload = frame_bytes({0xA5, 0x5A, 0x01, 0x00, 0xA5});
  std::array<std::byte, 16> frame{};
  const std::size_t size = write_serial_frame(0x30, payload, frame);
  const Bytes stream(frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(size));
  CHECK(seen_in(stream + frame_b) == std::vector<Seen>{{0x30, payload}, seen_b});
}

TEST_CASE("a truncated frame costs at most the frame after it", "[phantom][framing]") {
  SerialFrames frames(SerialFrames::Expected{0x04, 3});
  const Bytes truncated(frame_a.begin(), frame_a.end() - 2);
  for (int cut = 1; cut < 7; ++cut) {
    CAPTURE(cut);
    const Bytes stump(frame_a.begin(), frame_a.begin() + cut);
    const std::vector<Seen> seen = feed(frames, stump + frame_a + frame_a + frame_a);
    REQUIRE(seen.size() >= 3);
    REQUIRE(seen.back() == seen_a);
    REQUIRE(seen[seen.size() - 2] == seen_a);
  }
}

TEST_CASE("a reader of one kind of frame is not delayed by apparent headers of another kind", "[phantom][framing]") {
  SerialFrames frames(SerialFrames::Expected{0x04, 3});
  CHECK(feed(frames, frame_bytes({0xA5, 0x5A, 0x77, 0xFF}) + frame_a) == std::vector<Seen>{seen_a});
  CHECK(feed(frames, frame_bytes({0xA5, 0x5A, 0x04, 0x04}) + frame_a) == std::vector<Seen>{seen_a});
  CHECK(feed(frames, frame_bytes({0xA5, 0x5A, 0xA5, 0x5A}) + frame_a) == std::vector<Seen>{seen_a});
  CHECK(feed(frames, frame_bytes({0xA5, 0x5A, 0x04, 0xA5}) + Bytes(frame_a.begin() + 1, frame_a.end())) ==
        std::vector<Seen>{seen_a});
  CHECK(feed(frames, frame_b + frame_empty).empty());
}

TEST_CASE("the longest frame fits, and every byte of a stream belongs to a frame or is counted", "[phantom][framing]") {
  Bytes payload(255);
  for (std::size_t i = 0; i < payload.size(); ++i) payload[i] = static_cast<std::byte>(i);
  std::array<std::byte, 259> frame{};
  REQUIRE(write_serial_frame(0xFF, payload, frame) == 259);
  CHECK(seen_in(Bytes(frame.begin(), frame.end())) == std::vector<Seen>{{0xFF, payload}});
  CHECK(write_serial_frame(0xFF, payload, std::span(frame).first(258)) == 0);
  CHECK(write_serial_frame(0xFF, Bytes(256), frame) == 0);

  std::mt19937 random(5);
  SerialFrames frames;
  std::uint64_t fed = 0, in_frames = 0;
  for (int i = 0; i < 20000; ++i) {
    Bytes part(random() % 9);
    for (std::byte& byte : part) byte = random() % 3 == 0 ? std::byte{0xA5} : std::byte(random() % 3 ? 0x5A : 7);
    fed += part.size();
    for (const Seen& seen : feed(frames, part)) in_frames += 4 + seen.payload.size();
  }
  frames.reset();
  CHECK(in_frames > 400);
  CHECK(in_frames + frames.skipped() == fed);
}

TEST_CASE("an interrupted stream starts afresh", "[phantom][framing]") {
  SerialFrames frames;
  feed(frames, frame_bytes({0xA5, 0x5A, 0x04, 0x03, 1}));
  frames.reset();
  CHECK(frames.skipped() == 5);
  CHECK(feed(frames, frame_b) == std::vector<Seen>{seen_b});
}

TEST_CASE("finding frames does not allocate", "[phantom][framing]") {
  SerialFrames frames;
  std::size_t found = 0;
  const Bytes stream = frame_bytes({3, 0xA5}) + frame_a + frame_b;
  const std::size_t before = calligraphy_test::allocations();
  for (int i = 0; i < 100; ++i) frames.feed(stream, [&](const SerialFrame&) { ++found; });
  CHECK(calligraphy_test::allocations() == before);
  CHECK(found == 200);
}
