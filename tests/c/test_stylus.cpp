// What a pen senses besides its place goes through the C interface.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <calligraphy/base/stylus_state.hpp>

#include "c_interface.hpp"

using namespace calligraphy_test;

namespace {

/// Of any but the twist.
calligraphy_stylus sensed(double pressure) {
  auto stylus = sized<calligraphy_stylus>();
  stylus.known = CALLIGRAPHY_STYLUS_PRESSURE | CALLIGRAPHY_STYLUS_FORCE | CALLIGRAPHY_STYLUS_ALTITUDE |
                 CALLIGRAPHY_STYLUS_AZIMUTH | CALLIGRAPHY_STYLUS_HEIGHT;
  stylus.pressure = pressure;
  stylus.force = 0.0;  // known to be none
  stylus.altitude = 1.1;
  stylus.azimuth = -0.1;
  stylus.twist = 5.0;  // of no meaning: it is not known
  stylus.height = 1.0 / 3.0;
  return stylus;
}

/// The members of a stylus as results have them.
std::vector<double> values(const calligraphy_stylus& from) {
  return {from.pressure, from.force, from.altitude, from.azimuth, NAN, from.height};
}

bool same(const double* found, const std::vector<double>& expected) {
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (!(found[i] == expected[i] || (std::isnan(found[i]) && std::isnan(expected[i])))) return false;
  }
  return true;
}

bool has(const calligraphy_device_state& found, const calligraphy_stylus& expected) {
  return found.stylus_known == expected.known && same(&found.stylus_pressure, values(expected));
}

Owned<calligraphy_device> pointer_device() {
  const auto capabilities = profile("ideal");
  auto mapping = sized<calligraphy_mapping>();
  REQUIRE(calligraphy_page_mapping(page_of("十").get(), CALLIGRAPHY_UPRIGHT, 1.0, &mapping) == CALLIGRAPHY_OK);
  calligraphy_device* device = nullptr;
  REQUIRE(calligraphy_pointer_device_create(&capabilities, nullptr, nullptr, &mapping, &device) == CALLIGRAPHY_OK);
  return Owned<calligraphy_device>(device);
}

Owned<calligraphy_recording> recording() {
  calligraphy_recording* made = nullptr;
  REQUIRE(calligraphy_recording_create(page_of("十").get(), 0.0, &made) == CALLIGRAPHY_OK);
  return Owned<calligraphy_recording>(made);
}

struct Path {
  std::vector<double> samples;  ///< 9 values of each
  std::vector<std::int32_t> buttons;
};

Path read_path(const calligraphy_traces* traces, std::int32_t place, std::int32_t index) {
  std::size_t count = 0;
  REQUIRE(calligraphy_traces_read_path(traces, 0, place, index, nullptr, nullptr, 0, &count) == CALLIGRAPHY_OK);
  Path path{std::vector<double>(9 * count), std::vector<std::int32_t>(count)};
  REQUIRE(calligraphy_traces_read_path(traces, 0, place, index, path.samples.data(), path.buttons.data(), count,
                                       &count) == CALLIGRAPHY_OK);
  REQUIRE(path.buttons.size() == count);
  return path;
}

}  // namespace

TEST_CASE("what a pen senses goes through a pointer device and a recording to the last bit") {
  const auto device = pointer_device();
  const auto kept = recording();
  std::vector<calligraphy_device_state> states;
  for (const double pressure : {0.1, 0.7}) {
    auto state = sized<calligraphy_device_state>();
    auto tick = sized<calligraphy_tick>();
    const auto stylus = sensed(pressure);
    REQUIRE(calligraphy_device_move_pen(device.get(), 0.08, 0.06, 0.5, CALLIGRAPHY_BUTTON_ERASER, &stylus) ==
            CALLIGRAPHY_OK);
    REQUIRE(calligraphy_device_read(device.get(), &state) == CALLIGRAPHY_OK);
    CHECK(has(state, stylus));
    CHECK(state.buttons == CALLIGRAPHY_BUTTON_ERASER);
    REQUIRE(calligraphy_recording_add_with_input(kept.get(), &tick, &state) == CALLIGRAPHY_OK);
    states.push_back(state);
  }
  for (std::int32_t i = 0; i < 2; ++i) {
    auto found = sized<calligraphy_device_state>();
    REQUIRE(calligraphy_recording_input(kept.get(), i, &found) == CALLIGRAPHY_OK);
    CHECK(std::memcmp(&found, &states[static_cast<std::size_t>(i)], sizeof found) == 0);
  }

  // A pointer senses nothing besides.
  auto state = sized<calligraphy_device_state>();
  REQUIRE(calligraphy_device_move_pointer(device.get(), 0.08, 0.06, 0.5, 0) == CALLIGRAPHY_OK);
  REQUIRE(calligraphy_device_read(device.get(), &state) == CALLIGRAPHY_OK);
  CHECK(state.stylus_known == 0);
  CHECK(same(&state.stylus_pressure, std::vector<double>(6, NAN)));
}

TEST_CASE("a recording has the samples of all ticks or of none") {
  const auto with = recording(), without = recording();
  const auto tick = sized<calligraphy_tick>();
  const auto state = sized<calligraphy_device_state>();
  REQUIRE(calligraphy_recording_add_with_input(with.get(), &tick, &state) == CALLIGRAPHY_OK);
  CHECK(calligraphy_recording_add(with.get(), &tick) == CALLIGRAPHY_INVALID_VALUE);
  CHECK(last_error() == "the recording has 1 ticks with their samples: it has those of all ticks or of none");
  REQUIRE(calligraphy_recording_add(without.get(), &tick) == CALLIGRAPHY_OK);
  CHECK(calligraphy_recording_add_with_input(without.get(), &tick, &state) == CALLIGRAPHY_INVALID_VALUE);
  CHECK(error_says("1 ticks without their samples"));
  auto found = sized<calligraphy_device_state>();
  CHECK(calligraphy_recording_input(without.get(), 0, &found) == CALLIGRAPHY_INVALID_VALUE);
}

TEST_CASE("a program that knows no stylus in a device state reads and supplies one of its size") {
  constexpr auto its_size = static_cast<std::uint32_t>(offsetof(calligraphy_device_state, stylus_known));
  const auto device = pointer_device();
  const auto stylus = sensed(0.5);
  REQUIRE(calligraphy_device_move_pen(device.get(), 0.08, 0.06, 0.5, 3, &stylus) == CALLIGRAPHY_OK);
  calligraphy_device_state state;
  std::memset(&state, 0x55, sizeof state);
  const calligraphy_device_state untouched = state;
  state.size = its_size;
  REQUIRE(calligraphy_device_read(device.get(), &state) == CALLIGRAPHY_OK);
  CHECK(state.size == its_size);
  CHECK(state.buttons == 3);
  CHECK(std::memcmp(&state.stylus_known, &untouched.stylus_known, sizeof state - its_size) == 0);

  const auto kept = recording();
  const auto tick = sized<calligraphy_tick>();
  auto found = sized<calligraphy_device_state>();
  REQUIRE(calligraphy_recording_add_with_input(kept.get(), &tick, &state) == CALLIGRAPHY_OK);
  REQUIRE(calligraphy_recording_input(kept.get(), 0, &found) == CALLIGRAPHY_OK);
  CHECK(std::memcmp(found.position, state.position, sizeof state.position) == 0);
  CHECK(found.stylus_known == 0);
  REQUIRE(calligraphy_device_supply(host_device(profile()).get(), &state) == CALLIGRAPHY_OK);
  state.size = its_size - 1;
  CHECK(calligraphy_device_read(device.get(), &state) == CALLIGRAPHY_INVALID_VALUE);
  CHECK(error_says("at least 112"));
}

TEST_CASE("pen traces go through their text with what the pen senses to the last bit") {
  calligraphy_traces* handle = nullptr;
  REQUIRE(calligraphy_traces_create(&handle) == CALLIGRAPHY_OK);
  const Owned<calligraphy_traces> traces(handle);
  REQUIRE(calligraphy_traces_begin(traces.get(), U'十', "pupil", 0.0) == CALLIGRAPHY_OK);
  const auto add = [&](double x, double time, const calligraphy_stylus* stylus, std::int32_t buttons) {
    REQUIRE(calligraphy_traces_add(traces.get(), x, 0.5, time, stylus, buttons) == CALLIGRAPHY_OK);
  };
  const auto light = sensed(0.1), firm = sensed(1.0 / 7.0);
  REQUIRE(calligraphy_traces_begin_path(traces.get(), CALLIGRAPHY_PEN_DOWN) == CALLIGRAPHY_OK);
  add(0.25, 0.0, &light, CALLIGRAPHY_BUTTON_TIP | CALLIGRAPHY_BUTTON_BARREL);
  add(0.75, 0.125, nullptr, -1);
  REQUIRE(calligraphy_traces_begin_path(traces.get(), CALLIGRAPHY_PEN_IN_AIR) == CALLIGRAPHY_OK);
  add(0.625, 0.25, &firm, 0);
  REQUIRE(calligraphy_traces_begin_path(traces.get(), CALLIGRAPHY_PEN_DOWN) == CALLIGRAPHY_OK);
  add(0.5, 0.5, &firm, -1);

  const char* text = nullptr;
  REQUIRE(calligraphy_traces_text(traces.get(), "by a pupil\nat school", &text) == CALLIGRAPHY_OK);
  CHECK(std::string(text).rfind("# by a pupil\n# at school\nV 2\nC 十 5341 pupil 1000 2 1\n", 0) == 0);
  REQUIRE(calligraphy_traces_from_memory(text, std::strlen(text), nullptr, &handle) == CALLIGRAPHY_OK);
  const Owned<calligraphy_traces> back(handle);
  std::int32_t count = 0;
  REQUIRE(calligraphy_traces_count(back.get(), &count) == CALLIGRAPHY_OK);
  REQUIRE(count == 1);
  auto info = sized<calligraphy_trace_info>();
  REQUIRE(calligraphy_traces_read_info(back.get(), 0, &info) == CALLIGRAPHY_OK);
  CHECK(info.code == U'十');
  CHECK(info.set == std::string("pupil"));
  CHECK(info.em == 1000.0);
  CHECK(info.path_count == 2);
  CHECK(info.has_air == 1);

  for (const auto* each : {traces.get(), back.get()}) {
    const Path first = read_path(each, CALLIGRAPHY_PEN_DOWN, 0), between = read_path(each, CALLIGRAPHY_PEN_IN_AIR, 1),
               second = read_path(each, CALLIGRAPHY_PEN_DOWN, 1);
    CHECK(first.buttons == std::vector<std::int32_t>{3, -1});
    REQUIRE(first.samples.size() == 18);
    CHECK(same(first.samples.data(), {0.25, 0.5, 0.0}));
    CHECK(same(first.samples.data() + 3, values(light)));
    CHECK(same(first.samples.data() + 9, {0.75, 0.5, 0.125, NAN, NAN, NAN, NAN, NAN, NAN}));
    CHECK(between.buttons == std::vector<std::int32_t>{0});
    CHECK(same(between.samples.data(), {0.625, 0.5, 0.25}));
    CHECK(same(between.samples.data() + 3, values(firm)));
    CHECK(second.buttons == std::vector<std::int32_t>{-1});
    CHECK(same(second.samples.data() + 3, values(firm)));
    CHECK(read_path(each, CALLIGRAPHY_PEN_IN_AIR, 0).buttons.empty());
    CHECK(read_path(each, CALLIGRAPHY_PEN_IN_AIR, 2).buttons.empty());
  }
}
