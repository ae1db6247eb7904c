#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <calligraphy/devices/phantom/wire_profile.hpp>

#include "devices/phantom/wire/frame_field.hpp"
#include "devices/phantom/wire/packet_codec.hpp"
#include "devices/phantom/wire/wrapping_count.hpp"

#include "../../allocation_counter.hpp"
#include "../../catch.hpp"
#include "profile_text.hpp"

using namespace calligraphy;
using namespace calligraphy::phantom;
using calligraphy_test::minimal_profile;
using calligraphy_test::parsed;

namespace {

std::vector<std::byte> bytes(std::initializer_list<int> values) {
  std::vector<std::byte> result;
  for (const int value : values) result.push_back(static_cast<std::byte>(value));
  return result;
}

/// A report according to the public description of the Omni, assembled by hand from 16-bit little-endian words.
std::vector<std::byte> omni_report(std::array<int, 3> encoders, std::array<int, 3> gimbal, int word_9,
                                   std::uint32_t sequence) {
  std::vector<std::byte> frame(44);
  const auto word = [&](int index, int value) {
    frame[static_cast<std::size_t>(2 * index)] = static_cast<std::byte>(value & 0xFF);
    frame[static_cast<std::size_t>(2 * index + 1)] = static_cast<std::byte>(value >> 8 & 0xFF);
  };
  for (int i = 0; i < 3; ++i) {
    const auto joint = static_cast<std::size_t>(i);
    word(2 + i, encoders[joint]);
    word(5 + i, gimbal[joint]);
    word(11 + i, ~gimbal[joint]);
  }
  word(9, word_9);
  word(16, static_cast<int>(sequence & 0xFFFF));
  word(17, static_cast<int>(sequence >> 16));
  return frame;
}

RawSample random_sample(const WireProfile& profile, std::mt19937& random) {
  RawSample sample;
  for (std::size_t joint = 0; joint < 3; ++joint) {
    sample.encoders[joint] = random() & 0xFFFF;
    sample.gimbal[joint] = random() & 0x7FF;
  }
  sample.buttons = random() & 3;
  sample.docked = (random() & 1) != 0;
  sample.sequence = static_cast<std::uint32_t>(random());
  if (!profile.faults.empty() && random() % 4 == 0) sample.fault = profile.faults[random() % 2].fault;
  return sample;
}

bool same(const RawSample& a, const RawSample& b) {
  return a.encoders == b.encoders && a.gimbal == b.gimbal && a.buttons == b.buttons && a.docked == b.docked &&
         a.sequence == b.sequence && a.fault == b.fault;
}

}  // namespace

TEST_CASE("a report in the published layout of the Omni is decoded to its values", "[phantom][codec]") {
  const PacketCodec codec(wire_profile("omni"));
  // The lower five bits of a gimbal word and of its copy are noise; buttons and inkwell are active low.
  std::vector<std::byte> frame = omni_report({0x1234, 0xFFFF, 1}, {0x8000 | 7, 0x0020, 0xFFE0}, 0xF9 << 8, 0x89ABCDEF);
  frame[22] ^= std::byte{0x15};
  const RawSample sample = codec.decode_report(frame);
  CHECK(sample.fault == DeviceFault::none);
  CHECK(sample.encoders == PerJoint<std::int64_t>{0x1234, 0xFFFF, 1});
  CHECK(sample.gimbal == PerJoint<std::int64_t>{0x400, 1, 0x7FF});
  CHECK(sample.buttons == 0b10);
  CHECK(sample.docked);
  CHECK(sample.sequence == 0x89ABCDEF);
  CHECK(codec.decode_report(omni_report({}, {}, 0xFF << 8, 0)).buttons == 0);
  CHECK_FALSE(codec.decode_report(omni_report({}, {}, 0xFF << 8, 0)).docked);
}

TEST_CASE("a command in the published layout of the Omni is encoded to its bytes", "[phantom][codec]") {
  const PacketCodec codec(wire_profile("omni"));
  std::array<std::byte, 16> frame{};
  RawCommand command;
  REQUIRE(codec.encode_command(command, frame) == 16);
  CHECK(std::vector(frame.begin(), frame.end()) ==
        bytes({0xFF, 0x07, 0xFF, 0x07, 0xFF, 0x07, 0xC0, 0x53, 0, 0, 0, 0, 0, 0, 0, 0}));
  command.torque = {1, -1, -2047};
  command.motors_on = true;
  command.dock_light = true;
  REQUIRE(codec.encode_command(command, frame) == 16);
  CHECK(std::vector(frame.begin(), frame.end()) ==
        bytes({0x00, 0x08, 0xFE, 0x07, 0x00, 0x00, 0xC9, 0x53, 0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST_CASE("torque beyond the range of the DAC is clamped and never wraps", "[phantom][codec]") {
  const PacketCodec codec(wire_profile("omni"));
  std::array<std::byte, 16> frame{};
  for (const std::int64_t torque : {std::int64_t{2048}, std::int64_t{4096}, std::int64_t{1} << 40}) {
    codec.encode_command({{torque, -torque, 0}, true, false, false, DeviceFault::none}, frame);
    CHECK(codec.decode_command(frame).torque == PerJoint<std::int64_t>{2047, -2047, 0});
  }
}

TEST_CASE("encoding and decoding round-trip in both directions for every built-in profile", "[phantom][codec]") {
  for (const std::string& name : wire_profile_names()) {
    const PacketCodec codec(wire_profile(name));
    std::mt19937 random(7);
    std::array<std::byte, 64> frame{};
    for (int i = 0; i < 2000; ++i) {
      const RawSample sample = random_sample(codec.profile(), random);
      const std::size_t size = codec.encode_report(sample, frame);
      REQUIRE(size == codec.profile().report_size);
      REQUIRE(same(codec.decode_report(std::span(frame).first(size)), sample));
      RawCommand command;
      for (std::int64_t& torque : command.torque) torque = static_cast<std::int64_t>(random() % 4095) - 2047;
      command.motors_on = random() % 2 == 0;
      command.dock_light = random() % 2 == 0;
      command.toggle = codec.profile().toggle && random() % 2 == 0;
      const std::size_t command_size = codec.encode_command(command, frame);
      const RawCommand again = codec.decode_command(std::span(frame).first(command_size));
      REQUIRE(again.fault == DeviceFault::none);
      REQUIRE(again.torque == command.torque);
      REQUIRE(again.motors_on == command.motors_on);
      REQUIRE(again.dock_light == command.dock_light);
      REQUIRE(again.toggle == command.toggle);
    }
  }
}

TEST_CASE("a frame of the wrong size is empty, short or overlong", "[phantom][codec]") {
  const PacketCodec codec(wire_profile("simulated"));
  std::vector<std::byte> frame(60);
  REQUIRE(codec.encode_report({}, frame) == 44);
  for (std::size_t size = 0; size <= frame.size(); ++size) {
    const DeviceFault expected = size == 0    ? DeviceFault::empty_frame
                                 : size < 44  ? DeviceFault::short_frame
                                 : size == 44 ? DeviceFault::none
                                              : DeviceFault::overlong_frame;
    REQUIRE(codec.decode_report(std::span(frame).first(size)).fault == expected);
    REQUIRE(is_readable(expected) == (size == 44));
  }
  CHECK(codec.decode_command(std::span(frame).first(15)).fault == DeviceFault::short_frame);
  CHECK(codec.encode_report({}, std::span(frame).first(43)) == 0);
  CHECK(codec.encode_command({}, std::span(frame).first(15)) == 0);
}

TEST_CASE("every flipped bit of a simulated report is detected", "[phantom][codec]") {
  const PacketCodec codec(wire_profile("simulated"));
  std::mt19937 random(3);
  std::vector<std::byte> frame(44);
  codec.encode_report(random_sample(codec.profile(), random), frame);
  for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
    std::vector<std::byte> flipped = frame;
    flipped[bit / 8] ^= std::byte{1} << static_cast<int>(bit % 8);
    CAPTURE(bit);
    REQUIRE(codec.decode_report(flipped).fault == DeviceFault::corrupted_frame);
  }
}

TEST_CASE("every flipped bit of a simulated command is detected", "[phantom][codec]") {
  const PacketCodec codec(wire_profile("simulated"));
  std::array<std::byte, 16> frame{};
  codec.encode_command({{5, -6, 7}, true, true, false, DeviceFault::none}, frame);
  for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
    std::array<std::byte, 16> flipped = frame;
    flipped[bit / 8] ^= std::byte{1} << static_cast<int>(bit % 8);
    const RawCommand command = codec.decode_command(flipped);
    REQUIRE(command.fault == DeviceFault::corrupted_frame);
    REQUIRE_FALSE(command.motors_on);
  }
}

TEST_CASE("the gimbal copies reveal corruption in the layout of the Omni", "[phantom][codec]") {
  const PacketCodec codec(wire_profile("omni"));
  const std::vector<std::byte> good = omni_report({1, 2, 3}, {0x100, 0x200, 0x300}, 0xFF << 8, 5);
  REQUIRE(codec.decode_report(good).fault == DeviceFault::none);
  for (const std::size_t byte : {11u, 13u, 15u, 23u, 25u, 27u}) {
    std::vector<std::byte> bad = good;
    bad[byte] ^= std::byte{0x10};
    CHECK(codec.decode_report(bad).fault == DeviceFault::corrupted_frame);
  }
  // A dead link shows one level on every line, so an inverted copy cannot match.
  CHECK(codec.decode_report(std::vector<std::byte>(44)).fault == DeviceFault::corrupted_frame);
  CHECK(codec.decode_report(std::vector<std::byte>(44, std::byte{0xFF})).fault == DeviceFault::corrupted_frame);
}

TEST_CASE("fields of any width, offset, byte order and sign round-trip", "[phantom][codec]") {
  const std::vector<std::byte> frame = bytes({0x12, 0x34, 0x56, 0x78, 0x9A, 0xBC});
  const auto field = [](int offset, int width, int low, int bits, bool big, bool is_signed, bool inverted) {
    return Field{offset, width, low, bits, big, is_signed, inverted};
  };
  CHECK(read_field(field(0, 1, 0, 8, false, false, false), frame) == 0x12);
  CHECK(read_field(field(1, 2, 0, 16, false, false, false), frame) == 0x5634);
  CHECK(read_field(field(1, 2, 0, 16, true, false, false), frame) == 0x3456);
  CHECK(read_field(field(1, 3, 0, 24, true, false, false), frame) == 0x345678);
  CHECK(read_field(field(2, 4, 0, 32, false, false, false), frame) == 0xBC9A7856);
  CHECK(read_field(field(2, 4, 0, 32, true, false, true), frame) == 0xA9876543);
  CHECK(read_field(field(4, 1, 0, 8, false, true, false), frame) == 0x9A - 256);
  CHECK(read_field(field(4, 2, 4, 8, false, false, false), frame) == 0xC9);
  CHECK(read_field(field(4, 2, 4, 8, false, true, true), frame) == 0x36);
  CHECK(read_field(field(2, 4, 0, 32, false, true, false), frame) == 0xBC9A7856LL - (1LL << 32));

  std::mt19937 random(11);
  for (int i = 0; i < 5000; ++i) {
    const int width = 1 + static_cast<int>(random() % 4);
    const int bits = 1 + static_cast<int>(random() % static_cast<unsigned>(8 * width));
    const int low = static_cast<int>(random() % static_cast<unsigned>(8 * width - bits + 1));
    const Field any{
        static_cast<int>(random() % 3), width, low, bits, random() % 2 == 0, random() % 2 == 0, random() % 2 == 0};
    std::vector<std::byte> target(6), before;
    for (std::byte& byte : target) byte = static_cast<std::byte>(random());
    before = target;
    const auto [least, most] = range(any);
    const std::int64_t value = least + static_cast<std::int64_t>(random()) % (most - least + 1);
    write_field(any, value, target);
    REQUIRE(read_field(any, target) == value);
    write_field(any, read_field(any, before), target);
    REQUIRE(target == before);  // no other bit has changed
  }
}

TEST_CASE("a count continues across a wrap", "[phantom][codec]") {
  CHECK(min_step(0xFFFF, 0, 16) == 1);
  CHECK(min_step(0, 0xFFFF, 16) == -1);
  CHECK(min_step(5, 5, 16) == 0);
  CHECK(min_step(0, 0x7FFF, 16) == 0x7FFF);
  CHECK(min_step(0, 0x8000, 16) == -0x8000);
  CHECK(min_step(0xFFFFFFFF, 1, 32) == 2);
  CHECK(min_step(-0x8000, 0x7FFF, 16) == -1);  // a signed field wraps as well
}

TEST_CASE("decoding and encoding do not allocate", "[phantom][codec]") {
  const PacketCodec codec(wire_profile("simulated"));
  std::array<std::byte, 44> frame{};
  const std::size_t before = calligraphy_test::allocations();
  for (int i = 0; i < 100; ++i) {
    codec.encode_report({{i, -i, 7}, {}, 1, false, static_cast<std::uint32_t>(i), DeviceFault::none}, frame);
    codec.decode_report(frame);
    codec.encode_command({}, frame);
    codec.decode_command(std::span(frame).first(16));
  }
  CHECK(calligraphy_test::allocations() == before);
}

TEST_CASE("a profile without a command encodes an empty one", "[phantom][codec]") {
  const PacketCodec codec(parsed(minimal_profile));
  std::array<std::byte, 8> frame{};
  CHECK(codec.encode_command({{1, 2, 3}, true, true, true, DeviceFault::none}, frame) == 0);
  CHECK(codec.torque_range() == PerJoint<std::int64_t>{0, 0, 0});
  CHECK(codec.decode_report(bytes({1, 2, 3, 4, 5, 6, 7, 8})).encoders == PerJoint<std::int64_t>{0x201, 0x403, 0x605});
}
