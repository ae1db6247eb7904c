#include <bit>
#include <clocale>
#include <cmath>
#include <cstdint>
#include <limits>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/replay_device.hpp>
#include <calligraphy/practice/recording.hpp>

#include "../catch.hpp"
#include "../endless_text.hpp"
#include "../special_values.hpp"
#include "../temporary_directory.hpp"

using namespace calligraphy;

namespace {

using calligraphy_test::infinity;
using calligraphy_test::not_a_number;

const std::vector<double> hard_numbers = {0.0,
                                          -0.0,
                                          0.1,
                                          1.0 / 3.0,
                                          -1e-3,
                                          1e21,
                                          123456789.123456789,
                                          std::numeric_limits<double>::min(),
                                          std::numeric_limits<double>::denorm_min(),
                                          std::numeric_limits<double>::max(),
                                          std::numeric_limits<double>::lowest(),
                                          std::nextafter(1.0, 2.0),
                                          infinity,
                                          -infinity,
                                          not_a_number};

/// Every hard number in every column, every state, event and status.
Recording hard_recording() {
  Recording recording;
  recording.rate = 1000.0 / 3.0;
  recording.page = std::numeric_limits<std::uint32_t>::max();
  for (std::size_t i = 0; i < hard_numbers.size(); ++i) {
    const auto next = [i](std::size_t offset) { return hard_numbers[(i + offset) % hard_numbers.size()]; };
    RecordedSample sample;
    sample.time = next(0);
    sample.device_point = {next(1), next(2), next(3)};
    sample.pen_tip = {next(4), next(5), next(6)};
    sample.force = {next(7), next(8), next(9)};
    sample.state = static_cast<InteractionState>(i % 4);
    sample.events = static_cast<TickEvent>(i == 8 ? 255 : 1 << (i % 8));
    sample.status = static_cast<TickStatus>(i / 2 % 5);
    sample.character = i == 0 ? std::numeric_limits<int>::max() : static_cast<int>(i);
    sample.stroke = static_cast<int>(3 * i);
    sample.tick_ns = i == 1 ? std::numeric_limits<float>::denorm_min() : 0.1F * static_cast<float>(i);
    recording.samples.push_back(sample);
  }
  return recording;
}

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

bool same(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return bits(a.x()) == bits(b.x()) && bits(a.y()) == bits(b.y()) && bits(a.z()) == bits(b.z());
}

bool same(const RecordedSample& a, const RecordedSample& b) {
  return bits(a.time) == bits(b.time) && same(a.device_point, b.device_point) && same(a.pen_tip, b.pen_tip) &&
         same(a.force, b.force) && a.state == b.state && a.events == b.events && a.status == b.status &&
         a.character == b.character && a.stroke == b.stroke && a.tick_ns == b.tick_ns;
}

void check_same(const Recording& a, const Recording& b) {
  CHECK(bits(a.rate) == bits(b.rate));
  CHECK(a.page == b.page);
  REQUIRE(a.samples.size() == b.samples.size());
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    CAPTURE(i);
    CHECK(same(a.samples[i], b.samples[i]));
  }
}

std::string csv(const Recording& recording) {
  std::ostringstream out;
  write_recording(out, recording);
  return out.str();
}

Recording parsed(const std::string& text) {
  std::istringstream in(text);
  return read_recording(in, "trace.csv");
}

std::string error_of(const std::string& text) {
  try {
    parsed(text);
  } catch (const FormatError& error) {
    return error.what();
  }
  return "no error";
}

const std::string header =
    "time_s,device_x_m,device_y_m,device_z_m,tip_x_m,tip_y_m,tip_z_m,force_x_N,force_y_N,force_z_N,state,events,status,"
    "character,stroke,tick_ns\n";
const std::string head = header + "# rate_Hz=1000\n";
const std::string row = "0.5,1,2,3,4,5,6,7,8,9,WS,4,ok,0,1,250\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

struct GermanNumbers : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

}  // namespace

TEST_CASE("a recording is read only from a regular file, and the error names any other", "[practice]") {
  CHECK_THROWS_WITH(read_recording("/dev/zero"), "/dev/zero: is not a regular file");
  CHECK_THROWS_WITH(read_recording("none.csv"), "none.csv: cannot be opened: No such file or directory");
}

TEST_CASE("a recording beyond its limit is refused by its size, unread", "[practice]") {
  const TemporaryDirectory directory;
  const std::filesystem::path path = directory.path() / "large.csv";
  calligraphy_test::make_sparse_file(path, 3ull << 30);
  const std::size_t before = calligraphy_test::bytes_read_so_far();
  CHECK_THROWS_WITH(read_recording(path), path.string() + ": larger than the limit of 1073741824 bytes");
  CHECK(calligraphy_test::bytes_read_so_far() - before < 100'000);
}

TEST_CASE("a row without an end is refused after a few kilobytes, and quoted in part", "[practice]") {
  for (const std::string& beginning : {std::string(), header, header + "# rate_Hz=1000\n0.5"}) {
    calligraphy_test::EndlessText text(beginning, '1');
    try {
      read_recording(text.in, "trace.csv");
      FAIL("read");
    } catch (const FormatError& error) {
      CHECK_THAT(error.what(), Catch::Contains("the line is longer than 4096 bytes: it begins with '"));
      CHECK(std::string(error.what()).size() < 200);
    }
    CHECK(text.bytes_read < 100'000);
  }
}

TEST_CASE("a recording read back is identical to the last bit", "[practice]") {
  check_same(parsed(csv(hard_recording())), hard_recording());
  check_same(parsed(csv({})), {});

  Recording longer{500.0, {}};  // more than one chunk of output
  for (int i = 0; i < 2000; ++i) {
    RecordedSample sample;
    sample.time = i / 500.0;
    sample.device_point = {std::sin(i), std::cos(i), 1e-3 * i};
    longer.samples.push_back(sample);
  }
  check_same(parsed(csv(longer)), longer);
}

TEST_CASE("the first line names columns and units, and a row has these values", "[practice]") {
  RecordedSample sample;
  sample.time = 0.5;
  sample.device_point = {1, 2, 3};
  sample.pen_tip = {4, 5, 6};
  sample.force = {7, 8, 9};
  sample.state = InteractionState::writing;
  sample.events = TickEvent::stroke_started;
  sample.stroke = 1;
  sample.tick_ns = 250.0F;
  CHECK(csv({1000.0, {sample}}) == head + row);
  CHECK(same(parsed(head + row).samples.at(0), sample));
}

TEST_CASE("both kinds of line endings are read", "[practice]") {
  std::string text;
  for (const char c : head + row + row) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  check_same(parsed(text), parsed(head + row + row));
}

TEST_CASE("malformed CSV is an error naming the line and the value", "[practice]") {
  const auto second = [](const std::string& from, const std::string& to) {
    return error_of(head + row + replaced(row, from, to));
  };
  CHECK(second("0.5", "0,5") == "trace.csv:4: expected 16 values, found 17 in '0,5,1,2,3,4,5,6,7,8,9,WS,4,ok,0,1,250'");
  CHECK(second(",250", "") == "trace.csv:4: expected 16 values, found 15 in '0.5,1,2,3,4,5,6,7,8,9,WS,4,ok,0,1'");
  CHECK(second("0.5", "abc") == "trace.csv:4: time_s is 'abc': expected a number");
  CHECK(second("0.5", "") == "trace.csv:4: time_s is '': expected a number");
  CHECK(second("0.5", " 0.5") == "trace.csv:4: time_s is ' 0.5': expected a number");
  CHECK(second("0.5", "0.5s") == "trace.csv:4: time_s is '0.5s': expected a number");
  CHECK(second(",6,", ",1e999,") == "trace.csv:4: tip_z_m is '1e999': out of range");
  CHECK(second("WS", "ws") == "trace.csv:4: state is 'ws': expected SS, AS, CS or WS");
  CHECK(second("WS,4", "WS,256") == "trace.csv:4: events is '256': expected 0 to 255");
  CHECK(second("WS,4", "WS,1.5") == "trace.csv:4: events is '1.5': expected a number");
  CHECK(second("ok", "fine") == "trace.csv:4: status is 'fine': expected ok, stale, bad_sample, device_fault, bad_clock or bad_law");
  CHECK(second("ok,0", "ok,-1") == "trace.csv:4: character is '-1': expected 0 to 2147483647");
  CHECK(second("ok,0,1", "ok,0,2147483648") == "trace.csv:4: stroke is '2147483648': out of range");
  CHECK(second("250", "x") == "trace.csv:4: tick_ns is 'x': expected a number");
  CHECK(second(row, "\n").starts_with("trace.csv:4: expected 16 values, found 1 in ''"));
}

TEST_CASE("CSV that is not a recording is rejected naming the line", "[practice]") {
  CHECK(error_of("").starts_with("trace.csv:1: expected 'time_s,"));
  CHECK(error_of("time,x\n1,2\n").ends_with("found 'time,x'"));
  CHECK(error_of(header) == "trace.csv:2: expected '# rate_Hz=...', found ''");
  CHECK(error_of(header + row).starts_with("trace.csv:2: expected '# rate_Hz=...', found '0.5,"));
  for (const char* rate : {"0", "-1", "nan", "inf"}) {
    CHECK(error_of(header + "# rate_Hz=" + rate + "\n") ==
          std::string("trace.csv:2: rate_Hz is '") + rate + "': expected a finite number above 0");
  }
  CHECK(error_of(header + "# rate_Hz=1k\n") == "trace.csv:2: rate_Hz is '1k': expected a number");
  CHECK(error_of(header + "# rate_Hz=1000 page=-1\n") == "trace.csv:2: page is '-1': expected a number");
  CHECK(error_of(header + "# rate_Hz=1000 page=4294967296\n") == "trace.csv:2: page is '4294967296': out of range");
}

TEST_CASE("a file truncated anywhere within a line is rejected", "[practice]") {
  const std::string text = head + row + row;
  for (std::size_t size = 0; size < text.size(); ++size) {
    CAPTURE(size);
    const bool whole_lines = size >= head.size() && text[size - 1] == '\n';
    CHECK((error_of(text.substr(0, size)) == "no error") == whole_lines);
  }
}

TEST_CASE("a failing stream is not mistaken for the end of the file", "[practice]") {
  struct Failing : std::stringbuf {
    using std::stringbuf::stringbuf;
    int_type underflow() override { throw 1; }
    int_type uflow() override { throw 1; }
  } buffer;
  std::istream in(&buffer);
  CHECK_THROWS_AS(read_recording(in, "trace.csv"), FileError);
}

TEST_CASE("CSV does not depend on the locale of streams", "[practice]") {
  const std::string expected = csv(hard_recording());
  const std::locale before = std::locale::global(std::locale(std::locale(), new GermanNumbers));
  const std::string text = csv(hard_recording());
  std::ostringstream control;
  control << 1234.5;
  Recording again;
  std::string error;
  try {
    again = parsed(expected);
  } catch (const Error& caught) {
    error = caught.what();
  }
  std::locale::global(before);
  REQUIRE(control.str() == "1.234,5");
  CHECK(text == expected);
  CHECK(error == "");
  check_same(again, hard_recording());
}

TEST_CASE("CSV does not depend on the locale of the C library", "[practice]") {
  const std::string expected = csv(hard_recording());
  const std::string before = std::setlocale(LC_ALL, nullptr);
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr && std::setlocale(LC_ALL, "de_DE.utf8") == nullptr) {
    WARN("skipped: this machine has no locale de_DE.UTF-8");
    return;
  }
  const std::string text = csv(hard_recording());
  Recording again;
  std::string error;
  try {
    again = parsed(expected);
  } catch (const Error& caught) {
    error = caught.what();
  }
  std::setlocale(LC_ALL, before.c_str());
  CHECK(text == expected);
  CHECK(error == "");
  check_same(again, hard_recording());
}

TEST_CASE("device states are the device points in device axes, and faults and stale samples stay what they are",
          "[practice]") {
  MotionMapping mapping = desk_page(0.16, 0.12);
  mapping.scale = 2.0;
  Recording recording;
  for (int i = 0; i < 5; ++i) {
    RecordedSample sample;
    sample.time = 0.25 * i;
    sample.device_point = {0.1 * i, 0.05, -0.001 * i};
    sample.pen_tip = {9, 9, 9};
    recording.samples.push_back(sample);
  }
  recording.samples[1].status = TickStatus::bad_sample;
  recording.samples[2].status = TickStatus::device_fault;
  recording.samples[3].status = TickStatus::stale;
  const std::vector<DeviceState> states = device_states(recording, mapping);
  REQUIRE(states.size() == 5);
  for (std::size_t i = 0; i < 5; ++i) {
    CAPTURE(i);
    const RecordedSample& sample = recording.samples[i];
    CHECK(states[i].time == sample.time);
    CHECK(states[i].velocity.array().isNaN().all());
    CHECK(states[i].status == (i == 2 ? DeviceStatus::fault : i == 3 ? DeviceStatus::stale : DeviceStatus::ok));
    if (i == 1) {
      CHECK(states[i].position.array().isNaN().all());
    } else {
      CHECK((mapping.to_page(states[i].position) - sample.device_point).norm() < 1e-15);
    }
  }
  ReplayDevice device(states, {});
  while (!device.finished()) CHECK(device.read().velocity.allFinite());
}
