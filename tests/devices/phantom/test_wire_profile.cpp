#include <limits>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/phantom/wire_profile.hpp>

#include "../../catch.hpp"
#include "../../temporary_directory.hpp"
#include "profile_text.hpp"

using namespace calligraphy;
using namespace calligraphy::phantom;
using calligraphy_test::format_error;
using calligraphy_test::minimal_profile;
using calligraphy_test::parsed;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;

namespace {

std::string value_error(const WireProfile& profile) {
  try {
    validate(profile);
  } catch (const ValueError& error) {
    return error.what();
  }
  return {};
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

}  // namespace

TEST_CASE("the built-in profiles are valid and list what they lack", "[phantom][profile]") {
  const WireProfile& omni = wire_profile("omni");
  CHECK(omni.report_size == 44);
  CHECK(omni.command_size == 16);
  CHECK_THAT(omni.source, Contains("phantom-drivers") && Contains("LGPL"));
  CHECK(missing_for_position(omni) == std::vector<std::string>{"counts-per-radian", "docked-angles"});
  CHECK(missing_for_force(omni) == std::vector<std::string>{"counts-per-radian", "docked-angles", "torque-per-count"});
  CHECK(missing_for_force(wire_profile("simulated")).empty());
  for (const std::string& name : wire_profile_names()) {
    CHECK(wire_profile(name).name == name);
    CHECK(parsed(std::string(wire_profile_text(name))).report_size == wire_profile(name).report_size);
  }
  CHECK_THROWS_WITH(wire_profile_text("touch"), Contains("\"touch\"") && Contains("omni, simulated"));
  CHECK(missing_for_force(parsed(minimal_profile)) == std::vector<std::string>{"counts-per-radian", "docked-angles",
                                                                               "command", "dac 1", "dac 2", "dac 3",
                                                                               "torque-per-count"});
  CHECK_THROWS_WITH(wire_profile("touch"), Contains("\"touch\"") && Contains("omni, simulated"));
}

TEST_CASE("a profile is read line by line", "[phantom][profile]") {
  const WireProfile profile = parsed(
      "\xEF\xBB\xBF"
      "calligraphy wire profile 1\r\n"
      "name Lab 3, unit #2  \r\n"
      "source measured  # not a comment\n"
      "\n"
      "framing serial 0x21 34   # codes\n"
      "rate 500.5\n"
      "report 40\n"
      "encoder 1 s16 at 0\n"
      "encoder 2 u24 at 2 big\n"
      "encoder 3 u32 at 5 bits 4..23 inverted\n"
      "encoder-copy 1 s16 at 9 big inverted\n"
      "gimbal 2 u8 at 11\n"
      "button 2 u8 at 12 bit 7\n"
      "button 1 u8 at 12 bit 0 inverted\n"
      "docked u8 at 12 bit 1\n"
      "sequence u8 at 13\n"
      "fault overheated u8 at 14 bit 0\n"
      "fault link-error u8 at 14 bit 1\n"
      "expect s8 at 15 is -3\n"
      "report-checksum xor 0..20 u8 at 21\n"
      "command 12\n"
      "dac 1 s16 at 0 zero 0\n"
      "dac 3 u16 at 2 bits 4..15 zero 0x800\n"
      "constant u8 at 8 is 0x55\n"
      "motors-on u8 at 9 bit 0\n"
      "toggle u8 at 9 bit 1\n"
      "start 07 0a Ff\n"
      "start 08\n"
      "stop 09\n"
      "counts-per-radian 100 -200 3e2\n"
      "gravity 0.1 -0.2\n");
  CHECK(profile.name == "Lab 3, unit #2");
  CHECK(profile.source == "measured  # not a comment");
  CHECK(profile.framing == Framing::serial);
  CHECK(profile.report_code == 0x21);
  CHECK(profile.command_code == 34);
  CHECK(profile.rate == 500.5);
  CHECK(profile.encoders[0].is_signed);
  CHECK(profile.encoders[1].big_endian);
  CHECK(profile.encoders[1].bits == 24);
  CHECK(profile.encoders[2].low_bit == 4);
  CHECK(profile.encoders[2].bits == 20);
  CHECK(profile.encoders[2].inverted);
  CHECK(profile.encoder_copies[0]);
  CHECK_FALSE(profile.encoder_copies[1]);
  CHECK(profile.gimbal[1]->offset == 11);
  REQUIRE(profile.buttons.size() == 2);
  CHECK(profile.buttons[0].inverted);
  CHECK(profile.buttons[1].low_bit == 7);
  REQUIRE(profile.faults.size() == 2);
  CHECK(profile.faults[1].fault == DeviceFault::link_error);
  REQUIRE(profile.expected.size() == 1);
  CHECK(profile.expected[0].value == -3);
  CHECK(profile.report_checksum->kind == ChecksumKind::exclusive_or);
  CHECK(profile.report_checksum->last == 20);
  CHECK(profile.dac[0]->zero == 0);
  CHECK(profile.dac[2]->zero == 0x800);
  CHECK(profile.start ==
        std::vector<std::vector<std::byte>>{{std::byte{7}, std::byte{10}, std::byte{255}}, {std::byte{8}}});
  CHECK(profile.stop.size() == 1);
  CHECK(*profile.counts_per_radian == Eigen::Vector3d(100.0, -200.0, 300.0));
  CHECK(*profile.gravity == Eigen::Vector2d(0.1, -0.2));
  CHECK(missing_for_force(profile) == std::vector<std::string>{"docked-angles", "dac 2", "torque-per-count"});
}

TEST_CASE("an error in a profile names file, line and value", "[phantom][profile]") {
  const auto with = [](const std::string& line) { return format_error(minimal_profile + line + "\n"); };
  CHECK(with("gimbal 1 u16 at 6").empty());
  CHECK(with("wibble 3") == "lab.txt:7: unknown keyword 'wibble'");
  CHECK(with("encoder 1 u16 at 6") == "lab.txt:7: 'encoder 1' is already defined");
  CHECK(with("rate 1000 Hz") == "lab.txt:7: expected the end of the line, found 'Hz'");
  CHECK(with("rate fast") == "lab.txt:7: 'fast' is not a number");
  CHECK(with("gimbal 4 u16 at 6") == "lab.txt:7: 4 is out of range, must be 1 to 3");
  CHECK(with("gimbal 1 u12 at 6") == "lab.txt:7: 'u12' is not a field type (u8, u16, u24, u32, s8, s16, s24, s32)");
  CHECK(with("gimbal 1 u16 6") == "lab.txt:7: expected 'at', found '6'");
  CHECK(with("gimbal 1 u16 at 6 bits 3") == "lab.txt:7: '3' is not a range of bits, FIRST..LAST");
  CHECK(with("gimbal 1 u16 at 6 bits 3..16") == "lab.txt:7: 16 is out of range, must be 3 to 15");
  CHECK(with("gimbal 1 u16 at 6 bits 5..4") == "lab.txt:7: 4 is out of range, must be 5 to 15");
  CHECK(with("gimbal 1 u16 at 6 wide") == "lab.txt:7: expected the end of the line, found 'wide'");
  CHECK(with("gimbal 1 u16 at six") == "lab.txt:7: 'six' is not an integer");
  CHECK(with("expect u8 at 6 is 0x-1") == "lab.txt:7: '0x-1' is not an integer");
  CHECK(with("expect u8 at 6 = 1") == "lab.txt:7: expected 'is', found '='");
  CHECK(with("fault gremlins u8 at 6 bit 0") == "lab.txt:7: 'gremlins' is not a fault name");
  CHECK(with("framing morse") == "lab.txt:7: framing is 'morse', must be 'packet' or 'serial REPORT COMMAND'");
  CHECK(with("framing serial 256 1") == "lab.txt:7: 256 is out of range, must be 0 to 255");
  CHECK(with("report-checksum crc 0..3 u8 at 6") == "lab.txt:7: 'crc' is not a checksum type (sum, xor)");
  CHECK(with("start") == "lab.txt:7: expected bytes (two hexadecimal digits each), found none");
  CHECK(with("start 7") == "lab.txt:7: '7' is not a byte (two hexadecimal digits)");
  CHECK(with("start -7") == "lab.txt:7: '-7' is not a byte (two hexadecimal digits)");
  CHECK(with("name") == "lab.txt:7: 'name' is already defined");
  CHECK(with("source") == "lab.txt:7: 'source' is empty");
  CHECK(with("counts-per-radian 1 2") == "lab.txt:7: the end of the line is not a number");
  CHECK(with("button 1 u8") == "lab.txt:7: expected 'at', found the end of the line");
  CHECK(with("# p\xC3\xA4per") == "");
  CHECK(with("source p\xE4per") == "lab.txt:7: not a wire profile: it is not valid UTF-8");
  CHECK(with("# p\xE4per") == "lab.txt:7: not a wire profile: it is not valid UTF-8");
  CHECK_THAT(with("button 2 u8 at 6 bit 0"), Contains("button 2 of 1"));
  CHECK_THAT(format_error("no profile\n"), Contains("lab.txt:1: expected 'calligraphy wire profile 1'"));
  CHECK_THAT(format_error(""), Contains("lab.txt: empty"));
  CHECK_THAT(format_error("calligraphy wire profile 1\nname x\nreport 8\n"), Contains("'encoder 1' is missing"));
  CHECK_THAT(format_error(minimal_profile + std::string(2'000'000, ' ') + "\n"),
             Contains("lab.txt:7: longer than the 1048576 bytes"));
}

TEST_CASE("fields outside their frame or overlapping are rejected with both names", "[phantom][profile]") {
  const auto with = [](const std::string& line) { return format_error(minimal_profile + line + "\n"); };
  CHECK_THAT(with("gimbal 1 u16 at 7"), Contains("gimbal 1: offset = 7") && Contains("8 bytes of the report"));
  CHECK_THAT(with("gimbal 1 u16 at 5"), Contains("encoder 3 overlaps gimbal 1 in the report"));
  CHECK(with("gimbal 1 u16 at 5 bits 8..15").empty());
  CHECK_THAT(with("gimbal 1 u16 at 5 big bits 8..15"), Contains("encoder 3 overlaps gimbal 1"));
  CHECK_THAT(with("gimbal-copy 1 u16 at 6"), Contains("gimbal-copy 1 copies a field that is not defined"));
  CHECK_THAT(with("encoder-copy 1 u8 at 6"), Contains("encoder-copy 1: number of bits or sign"));
  CHECK_THAT(with("docked u8 at 6"), Contains("docked: number of bits = 8, must be 1"));
  CHECK_THAT(with("sequence u8 at 6 bits 0..2"), Contains("sequence: number of bits = 3, must be at least 4"));
  CHECK_THAT(with("report-checksum sum 0..6 u16 at 6"), Contains("report-checksum covers its own bytes"));
  CHECK_THAT(with("report-checksum sum 0..8 u8 at 6"), Contains("bytes 0..8 are outside the report"));
  CHECK_THAT(with("expect u8 at 6 is 256"), Contains("expect 1: value = 256, must be from 0 to 255"));
  CHECK_THAT(with("dac 1 u16 at 0 zero 0"), Contains("command size is 0"));
  CHECK_THAT(with("command 4\ndac 1 u16 at 0 zero 0"), Contains("dac 1: zero leaves no range"));
  CHECK_THAT(with("command 4\ndac 1 u16 at 0 bits 0..11 zero 4096"), Contains("dac 1: zero = 4096"));
  CHECK_THAT(with("command 4\ndac 1 s16 at 0 zero 0\nmotors-on u8 at 1 bit 2"), Contains("motors-on overlaps dac 1"));
  CHECK_THAT(with("command 600"), Contains("command size = 600 bytes, must be from 1 to 512"));
  CHECK_THAT(with("rate 0"), Contains("rate = 0 Hz, must be from 1 to 100000"));
  CHECK_THAT(with("counts-per-radian 5 0 5"), Contains("counts-per-radian = 0"));
  CHECK_THAT(with("counts-per-radian 5 nan 5"), Contains("counts-per-radian = nan"));
  CHECK_THAT(with("continuous-torque 1 -1 1"), Contains("continuous-torque = -1 N m, must be from 1e-06 to 100"));
  CHECK_THAT(with("gravity inf 0"), Contains("gravity = inf N m, must be at most 10 in size"));
}

TEST_CASE("an error in one statement of a profile is reported with its line", "[phantom][profile]") {
  const auto with = [](const std::string& lines) { return format_error(minimal_profile + lines + "\n"); };
  CHECK(with("source x\nrate 0") == "lab.txt:8: rate = 0 Hz, must be from 1 to 100000");
  CHECK(with("gimbal 1 u16 at 5") == "lab.txt:6: encoder 3 overlaps gimbal 1 in the report");
  CHECK_THAT(with("encoder-copy 1 u8 at 6"), StartsWith("lab.txt:7: encoder-copy 1: number of bits"));
  CHECK_THAT(with("report-checksum sum 0..8 u8 at 6"), StartsWith("lab.txt:7: report-checksum: bytes 0..8"));
  CHECK_THAT(with("expect u8 at 6 is 1\n\nexpect u8 at 7 is 256"), StartsWith("lab.txt:9: expect 2: value = 256"));
  CHECK_THAT(with("command 4\nconstant u8 at 0 is 1\nconstant u8 at 4 is 1"),
             StartsWith("lab.txt:9: constant 2: offset = 4"));
  CHECK_THAT(with("command 600\ncommand-checksum sum 0..1 u8 at 2"), StartsWith("lab.txt:7: command size = 600"));
  CHECK_THAT(with("fault overheated u8 at 6 bit 0\nfault overheated u8 at 6 bit 0"),
             StartsWith("lab.txt:8: fault 2 (overheated) overlaps fault 1 (overheated)"));
  CHECK_THAT(with("framing serial 1 2\nstart 07\nstop" + repeated(" 07", 257)),
             StartsWith("lab.txt:9: stop 1 has 257 bytes"));
  std::string buttons;
  for (int i = 1; i <= 11; ++i) buttons += "button " + std::to_string(i) + " u16 at 6 bit " + std::to_string(i) + "\n";
  CHECK_THAT(with(buttons + "button 12 u16 at 6 bit 1"), StartsWith("lab.txt:18: button 12 overlaps button 1 in"));
  // Errors of no single line.
  CHECK_THAT(with("dac 1 u16 at 0 zero 0"), StartsWith("lab.txt: command size is 0"));
}

TEST_CASE("a profile created by a program is validated like one from a file", "[phantom][profile]") {
  WireProfile profile = parsed(minimal_profile);
  CHECK(value_error(profile).empty());
  profile.encoders[1].bytes = 5;
  CHECK_THAT(value_error(profile), Contains("encoder 2: width = 5"));
  profile.encoders[1] = {std::numeric_limits<int>::max(), 1, 0, 8, false, false, false};
  CHECK_THAT(value_error(profile), Contains("encoder 2: offset = 2147483647"));
  profile.encoders[1] = {0, 1, std::numeric_limits<int>::max(), 8, false, false, false};
  CHECK_THAT(value_error(profile), Contains("encoder 2: highest bit = 2147483654"));
  profile = parsed(minimal_profile);
  profile.start.emplace_back();
  CHECK_THAT(value_error(profile), Contains("start 1 has 0 bytes"));
  profile = parsed(minimal_profile);
  profile.framing = Framing::serial;
  profile.report_size = 256;
  CHECK_THAT(value_error(profile), Contains("at most 255 bytes") && Contains("256"));
}

TEST_CASE("a profile is read from a file, and a missing file is named", "[phantom][profile]") {
  const TemporaryDirectory directory;
  const std::string path = (directory.path() / "lab.txt").string();
  directory.write("lab.txt", minimal_profile);
  CHECK(read_wire_profile(path).name == "small");
  CHECK_THROWS_AS(read_wire_profile(path + "x"), FileError);
  CHECK_THROWS_WITH(read_wire_profile(path + "x"), EndsWith(": cannot be opened: No such file or directory"));
  CHECK_THROWS_AS(read_wire_profile(directory.path().string()), FileError);
  CHECK_THROWS_WITH(read_wire_profile("/dev/zero"), "/dev/zero: is not a regular file");  // it never ends
}
