#include <algorithm>
#include <bit>
#include <cstdint>
#include <locale>
#include <sstream>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/practice/recording_file.hpp>
#include <calligraphy/practice/session.hpp>
#include <calligraphy/render/option_values.hpp>

#include "../catch.hpp"
#include "../endless_text.hpp"
#include "../special_values.hpp"
#include "../temporary_directory.hpp"
#include "pages.hpp"

using namespace calligraphy;
using namespace calligraphy_test;

namespace {

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}

bool same_bits(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return same_bits(a.x(), b.x()) && same_bits(a.y(), b.y()) && same_bits(a.z(), b.z());
}

bool same_bits(const DeviceState& a, const DeviceState& b) {
  return same_bits(a.time, b.time) && same_bits(a.position, b.position) && same_bits(a.velocity, b.velocity) &&
         a.velocity_estimated == b.velocity_estimated && same_bits(a.force, b.force) &&
         same_bits(a.force_settling, b.force_settling) && a.buttons == b.buttons && a.status == b.status &&
         a.fault == b.fault && a.stylus == b.stylus;
}

bool same_bits(const RecordedSample& a, const RecordedSample& b) {
  return same_bits(a.time, b.time) && same_bits(a.device_point, b.device_point) && same_bits(a.pen_tip, b.pen_tip) &&
         same_bits(a.force, b.force) && a.state == b.state && a.events == b.events && a.status == b.status &&
         a.character == b.character && a.stroke == b.stroke;
}

std::string text_of(const Recording& recording) {
  std::ostringstream out;
  write_recording(out, recording);
  return out.str();
}

StoredRecording read(const std::string& text) {
  std::istringstream in(text);
  return read_recording(in, "pen.recording");
}

/// How many ticks at the beginning are the same to the last bit.
std::size_t same_ticks(const Recording& a, const Recording& b) {
  const std::size_t count = std::min({a.samples.size(), b.samples.size(), a.inputs.size(), b.inputs.size()});
  std::size_t same = 0;
  while (same < count && same_bits(a.samples[same], b.samples[same]) && same_bits(a.inputs[same], b.inputs[same])) ++same;
  return same;
}

/// Sessions that differ in everything that a file has to keep.
std::vector<std::pair<std::string, Recording>> hard_recordings() {
  std::vector<std::pair<std::string, Recording>> all;
  const auto add = [&all](const std::string& name, const PracticePage& page, const SessionOptions& options) {
    all.emplace_back(name, write_page(page, options));
  };
  const PracticePage page = page_of("一一");
  SessionOptions options = session(WriterSkill::novice(), FeedbackMode::force);
  add("force", page, options);
  options.mode = FeedbackMode::vision;
  add("vision", page, options);
  options.mode = FeedbackMode::force;
  options.mapping = desk_page(page.width, page.height, 1.5);
  for (const char* name : {"omni", "premium-1.5", "ideal"}) {
    options.device = device_profile(name);
    options.renderer = RendererOptions::everything(options.device, 1.5);
    add(std::string("everything, desk, ") + name, page, options);
  }
  options.mapping = std::nullopt;
  options.renderer = RendererOptions::wang2006();
  add("wang2006", page, options);
  options.device = device_profile("desktop");
  options.device.sample_delay = 3;
  options.renderer = RendererOptions::for_device(options.device);
  options.renderer.servo_rate = 3000.0;
  add("late samples, 3 kHz", page, options);

  // What no simulation gives: a real device, a clock that stops, a pen with everything.
  Recording real = all.front().second;
  double scale = 1.0;
  for (std::size_t i = 0; i < real.inputs.size(); ++i) {
    DeviceState& input = real.inputs[i];
    if (i % 7 == 0) input.time += 1e-5 * scale, input.force = {0.1 / scale, -0.0, 1e-300};
    if (i % 50 == 3) input.time = real.inputs[i - 1].time, input.status = DeviceStatus::stale;
    if (i % 101 == 5) input.position.x() = i % 2 == 0 ? not_a_number : infinity;
    if (i % 103 == 6) input.position.y() += 1e-9;
    if (i % 107 == 7) input.velocity = {not_a_number, -infinity, 0.1}, input.velocity_estimated = i % 2 == 0;
    if (i % 109 == 8) input.status = DeviceStatus::fault, input.fault = DeviceFault::device_error;
    if (i % 113 == 9) input.fault = DeviceFault::lost_frames;
    if (i % 5 == 0) input.stylus = {0.1 * scale, scale, 1.0 / scale, -scale, 0.3, -1e-3}, input.buttons ^= eraser_button;
    if (i % 31 == 0) input.force_settling = 1e-4 / scale;
    scale = scale > 2.0 ? 0.1 : scale * 1.1;
  }
  all.emplace_back("real", replayed(real));
  options.law = ForceLaw([](const DeviceState& state) { return Eigen::Vector3d(-20.0 * state.position); });
  options.law.name = "spring\nto the origin";
  add("own law", page, options);
  return all;
}

}  // namespace

TEST_CASE("what is read from a file is the recording that was written, to the last bit", "[practice]") {
  for (const auto& [name, recording] : hard_recordings()) {
    CAPTURE(name);
    const std::string text = text_of(recording);
    const StoredRecording stored = read(text);
    CHECK(stored.is_complete);
    CHECK(stored.has_same_forces);
    CHECK(stored.recording.samples.size() == recording.samples.size());
    CHECK(same_ticks(stored.recording, recording) == recording.samples.size());
    CHECK(stored.recording.page == recording.page);
    CHECK(stored.recording.rate == recording.rate);
    const RecordingSetup &setup = *stored.recording.setup, &before = *recording.setup;
    CHECK(setup.mode == before.mode);
    CHECK(setup.has_own_law == before.has_own_law);
    CHECK(option_values(setup.renderer) == option_values(before.renderer));
    CHECK(stored.recording.law == (setup.has_own_law ? "spring to the origin" : recording.law));
    CHECK(setup.device.model == before.device.model);
    CHECK(text_of(stored.recording) == text);
  }
}

TEST_CASE("a file of a version without an option is read with its default", "[practice]") {
  std::string text = text_of(hard_recordings().front().second);
  const std::string option = "option tolerances.next_decides true\n";
  REQUIRE(text.find(option) != std::string::npos);
  text.erase(text.find(option), option.size());
  CHECK(read(text).recording.setup->renderer.tolerances.next_decides);
}

TEST_CASE("a file that was cut off anywhere has all ticks that were written whole", "[practice]") {
  const Recording recording = hard_recordings().front().second;
  const std::string text = text_of(recording);
  const std::size_t ticks = text.find("\nticks\n") + 7;
  for (std::size_t length = ticks; length < text.size(); length += 1 + length % 997) {
    CAPTURE(length);
    const auto whole = static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(ticks),
                                                           text.begin() + static_cast<std::ptrdiff_t>(length), '\n'));
    const StoredRecording stored = read(text.substr(0, length));
    CHECK_FALSE(stored.is_complete);
    CHECK_FALSE(stored.has_same_forces);
    CHECK(stored.recording.samples.size() == whole);
    CHECK(same_ticks(stored.recording, recording) == whole);
  }
  for (std::size_t length = 0; length < ticks; length += 17) CHECK_THROWS_AS(read(text.substr(0, length)), FormatError);
}

TEST_CASE("a recording can be stored while it is made", "[practice]") {
  const PracticePage page = page_of("一");
  SessionOptions options = session(WriterSkill::skilled(), FeedbackMode::force);
  std::ostringstream out;
  std::vector<std::size_t> sizes;
  std::optional<RecordingWriter> writer;
  options.keep = [&](const Recording& recording) {
    if (!writer) writer.emplace(out, recording);
    writer->add(recording);
    sizes.push_back(recording.samples.size());
    if (recording.samples.size() % 2048 == 0 && !sizes.empty()) CHECK(read(out.str()).recording.samples.size() == recording.samples.size());
  };
  const Recording recording = write_page(page, options);
  writer->finish();
  CHECK(out.str() == text_of(recording));
  CHECK(sizes.front() == 0);
  CHECK(sizes.size() > recording.samples.size() / 300);
}

TEST_CASE("a malformed file is an error that names the line and the value", "[practice]") {
  const std::string good = text_of(hard_recordings().front().second);
  struct Case {
    std::string from, to, message;
  };
  const Case cases[] = {
      {"calligraphy recording 1", "calligraphy recording 2", "expected 'calligraphy recording 1'"},
      {"\nrate ", "\nrates ", "unknown statement 'rates'"},
      {"\nrate 1000", "\nrate 0", "finite number above 0"},
      {"\nmapping 1", "\nmapping x", "'x'"},
      {"\nmode force", "\nmode sideways", "'sideways'"},
      {"\nmode force", "", "no statement 'mode'"},
      {"\nmode force", "\nmode force\nmode vision", "a second statement 'mode'"},
      {"\ndevice simulated 1", "\ndevice simulated yes", "'yes'"},
      {"\ndevice driven 1110", "\ndevice driven 111x", "'111x'"},
      {"\nend ", "\nendless ", "endless"},
      {"\nmapping 1", "\nmapping 2", "rotation"},
      {"\ndevice peak_force", "\ndevice peak", "'peak'"},
      {"\ndevice sample_delay 0", "\ndevice sample_delay -1", "'-1'"},
      {"\noption guidance.damping", "\noption guidance.dampin", "guidance.dampin"},
      {"\noption guidance.force linear", "\noption guidance.force own", "own"},
      {"\noption guidance.stiffness ", "\noption guidance.stiffness -", "guidance"},
      {"\nstroke 1 ", "\nstroke 99 ", "99"},
      {"\nticks\n", "\nticks\n1,2,3,4,5,6,7,0/0,9,10,11,12,13,14,15,16,17,18,19,20\n", "at the end of the line"},
      {"\nticks\n", "\nticks\n,x\n", "'x'"},
      {"\nticks\n", "\nticks\n,,,,,,,9\n", "'9'"},
      {"\nend ", "\nend 1", "of 1"},
      {"\nend ", "\nend x", "end x"},
  };
  for (const Case& each : cases) {
    CAPTURE(each.from, each.to);
    const std::size_t at = good.find(each.from);
    REQUIRE(at != std::string::npos);
    std::string bad = good;
    bad.replace(at, each.from.size(), each.to);
    try {
      read(bad);
      FAIL("read");
    } catch (const FormatError& error) {
      CHECK(std::string(error.what()).starts_with("pen.recording:"));
      CHECK_THAT(error.what(), Catch::Contains(each.message));
    }
  }
  CHECK_THROWS_WITH(read(good + "\n"), Catch::Contains("text after the end"));
  CHECK_THROWS_WITH(text_of(Recording()), Catch::Contains("without a set-up"));
  CHECK_THROWS_WITH(replayed(Recording()), Catch::Contains("without a set-up"));
}

TEST_CASE("a file with random bytes is either read or rejected with FormatError", "[practice]") {
  Recording recording = hard_recordings().front().second;
  recording.samples.resize(40), recording.inputs.resize(40);
  const std::string good = text_of(recording);
  std::uint32_t state = 1;
  int read_again = 0;
  for (int i = 0; i < 3000; ++i) {
    state = state * 1664525u + 1013904223u;
    std::string broken = good;
    broken[(state >> 8) % broken.size()] = static_cast<char>(state >> 24);
    try {
      for (const RecordedSample& sample : read(broken).recording.samples) REQUIRE(sample.force.allFinite());
      ++read_again;
    } catch (const FormatError&) {
    }
  }
  CHECK(read_again > 10);
}

TEST_CASE("recordings do not depend on the locale", "[practice]") {
  struct GermanNumbers : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const Recording recording = hard_recordings().front().second;
  const std::string expected = text_of(recording);
  const std::locale before = std::locale::global(std::locale(std::locale(), new GermanNumbers));
  const std::string text = text_of(recording);
  std::string error;
  try {
    read(expected);
  } catch (const Error& caught) {
    error = caught.what();
  }
  std::locale::global(before);
  CHECK(text == expected);
  CHECK(error == "");
}

TEST_CASE("a recording is read from a regular file of bounded size and bounded lines", "[practice]") {
  CHECK_THROWS_WITH(read_recording("/dev/zero"), "/dev/zero: is not a regular file");
  CHECK_THROWS_WITH(read_recording("none.recording"), "none.recording: cannot be opened: No such file or directory");
  const TemporaryDirectory directory;
  const std::filesystem::path path = directory.path() / "large.recording";
  make_sparse_file(path, 3ull << 30);
  CHECK_THROWS_WITH(read_recording(path), path.string() + ": larger than the limit of 1073741824 bytes");
  EndlessText text("calligraphy recording 1\nlaw ", '1');
  CHECK_THROWS_WITH(read_recording(text.in, "pen.recording"), Catch::Contains("the line is longer than 65536 bytes"));
  struct Failing : std::stringbuf {
    int_type underflow() override { throw 1; }
  } buffer;
  std::istream in(&buffer);
  CHECK_THROWS_AS(read_recording(in, "pen.recording"), FileError);
}

TEST_CASE("ticks in a table are rounded to what is known, and count time from the first one", "[practice]") {
  Recording recording;
  RecordedSample sample;
  sample.time = 100.25;
  sample.device_point = {0.0123456789, -0.1, 0.00000004};
  sample.pen_tip = {-0.00000004, 1.0, 12.5};
  sample.force = {-1.7e-14, 0.12345, 2.0};
  sample.state = InteractionState::writing;
  sample.events = TickEvent::lift;
  sample.tick_ns = 250.4F;
  recording.samples = {sample, sample};
  recording.samples[1].time = 100.251;
  std::ostringstream plain;
  write_ticks(plain, recording);
  CHECK(plain.str() ==
        "time_s,device_x_m,device_y_m,device_z_m,tip_x_m,tip_y_m,tip_z_m,force_x_N,force_y_N,force_z_N,state,events,"
        "status,character,stroke,tick_ns\n"
        "0,0.0123457,-0.1,0,0,1,12.5,0,0.1235,2,WS," + std::to_string(static_cast<int>(TickEvent::lift)) +
        ",ok,0,0,250\n"
        "0.001,0.0123457,-0.1,0,0,1,12.5,0,0.1235,2,WS," + std::to_string(static_cast<int>(TickEvent::lift)) +
        ",ok,0,0,250\n");
  recording.inputs.resize(2);
  recording.inputs[1].stylus = {0.5, not_a_number, 1.23456, -2.0, not_a_number, 0.0012};
  recording.inputs[1].buttons = barrel_button;
  std::ostringstream with_pen;
  write_ticks(with_pen, recording);
  CHECK_THAT(with_pen.str(), Catch::Contains("tick_ns,buttons,pressure,tip_force_N,altitude_rad,azimuth_rad,twist_rad,"
                                             "height_m\n"));
  CHECK_THAT(with_pen.str(), Catch::Contains(",250,0,,,,,,\n") && Catch::EndsWith(",250,2,0.5,,1.2346,-2,,0.0012\n"));
}
