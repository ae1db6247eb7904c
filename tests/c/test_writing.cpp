// A character written through the C interface is the same as through C++, to the last bit.
#include <cstring>
#include <vector>

#include <calligraphy/base/random.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/devices/pointer_device.hpp>
#include <calligraphy/devices/servo.hpp>
#include <calligraphy/devices/simulated_device.hpp>
#include <calligraphy/practice/hint_text.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

#include "allocation_counter.hpp"
#include "c_interface.hpp"
#include "pen_path.hpp"
#include "special_values.hpp"

using namespace calligraphy;
using namespace calligraphy_test;

namespace {

/// Where a pen means to be that writes a page, tick by tick [m, page]: with a tremor, and 1.5 mm beside the strokes.
/// Between two strokes it is lifted.
std::vector<Eigen::Vector3d> intended_path(const PracticePage& page, double speed = 0.1, double tremor = 3e-4) {
  Random random(7);
  std::vector<Eigen::Vector3d> path = {{0.5 * page.width, 0.5 * page.height, 0.02}};
  const auto go = [&](const Eigen::Vector3d& to) {
    const Eigen::Vector3d from = path.back();
    const int ticks = std::max(1, static_cast<int>((to - from).norm() / (speed * 1e-3)));
    for (int i = 1; i <= ticks; ++i) {
      const double x = random.between(-tremor, tremor);
      path.push_back(from + (to - from) * i / ticks + Eigen::Vector3d(x, random.between(-tremor, tremor), 0.0));
    }
  };
  for (const PlacedCharacter& placed : page.characters) {
    for (const Stroke& stroke : strokes(placed.character)) {
      const std::vector<Point> way = beside(path_of(stroke, placed.placement, 0.001), 0.0015);
      go({way.front().x(), way.front().y(), 0.008});
      for (const Point& point : way) go({point.x(), point.y(), -0.003});
      go({way.back().x(), way.back().y(), 0.008});
    }
  }
  return path;
}

template <class Vector, std::size_t size>
bool same(const Vector& a, const double (&b)[size]) {
  return std::memcmp(a.data(), b, sizeof b) == 0;
}

/// Every member of both.
bool same(const HapticTick& a, const calligraphy_tick& b) {
  return static_cast<int>(a.status) == b.status && static_cast<int>(a.state) == b.state &&
         static_cast<std::uint32_t>(a.events) == b.events && static_cast<int>(a.hint) == b.hint &&
         a.character == b.character && a.stroke == b.stroke && a.contact.element == b.element && a.time == b.time &&
         same(a.force, b.force) && same(a.page_force, b.page_force) && same(a.device_point, b.device_point) &&
         same(a.pen_tip, b.pen_tip) && a.penetration == b.penetration && same(a.to_start, b.to_start) &&
         a.covered == b.covered && same(a.contact.closest.point, b.closest) &&
         same(a.contact.closest.tangent, b.tangent) && a.contact.closest.distance == b.distance &&
         a.contact.arc == b.arc && a.contact.backwards == b.backwards && same(a.attraction, b.attraction) &&
         same(a.wrong_way, b.wrong_way) && same(a.friction, b.friction) && same(a.viscous, b.viscous) &&
         a.normal == b.normal && a.assistance == b.assistance && a.energy_given == b.energy_given && a.heat == b.heat;
}

}  // namespace

TEST_CASE("a text is laid out as its characters are read, and what differs is told") {
  calligraphy_set* set = nullptr;
  REQUIRE(calligraphy_set_built_in(&set) == CALLIGRAPHY_OK);
  auto read = sized<calligraphy_text_character>();
  const char* const text = "永 \u200B\u2F00\uFE00";
  REQUIRE(calligraphy_text_read(set, text, 0, &read) == CALLIGRAPHY_OK);
  CHECK(std::string(read.note).empty());
  REQUIRE(calligraphy_text_read(set, text, 1, &read) == CALLIGRAPHY_OK);
  CHECK((read.written == 0x2F00 && read.code == U'一' && read.selector == 0xFE00));
  CHECK(std::string(read.note).find("is read as 一 (U+4E00)") != std::string::npos);
  calligraphy_page* page = nullptr;
  REQUIRE(calligraphy_page_lay_out(set, text, nullptr, nullptr, &page) == CALLIGRAPHY_OK);
  auto placed = sized<calligraphy_placed_character>();
  REQUIRE(calligraphy_page_character(page, 1, &placed) == CALLIGRAPHY_OK);
  CHECK(placed.code == U'一');
  calligraphy_free(page);
  calligraphy_free(set);
}

TEST_CASE("a typical stroke is written alone") {
  calligraphy_set* set = nullptr;
  REQUIRE(calligraphy_set_typical_strokes(&set) == CALLIGRAPHY_OK);
  std::int32_t count = 0;
  for (const std::uint32_t code : {U'㇀', U'㇥', U'①', U'㊴'}) {
    CHECK(calligraphy_set_stroke_count(set, code, &count) == CALLIGRAPHY_OK);
    CHECK(count == 1);
  }
  calligraphy_free(set);
}

TEST_CASE("a page is written with the forces of C++ to the last bit") {
  const auto [preset, options_in_cpp] =
      GENERATE_COPY(table<calligraphy_preset, RendererOptions (*)(const Capabilities&)>(
          {{CALLIGRAPHY_PRESET_DEVICE, [](const Capabilities& c) { return RendererOptions::for_device(c, 1.5); }},
           {CALLIGRAPHY_PRESET_EVERYTHING, [](const Capabilities& c) { return RendererOptions::everything(c, 1.5); }},
           {CALLIGRAPHY_PRESET_WANG2006, [](const Capabilities&) { return RendererOptions::wang2006(); }}}));
  CAPTURE(preset);
  const PracticePage page = page_in_cpp(U"永一");
  const MotionMapping desk = desk_page(page.width, page.height, 1.5);
  Capabilities capabilities = device_profile("desktop");
  capabilities.simulated = true;
  HapticRenderer renderer(page.characters, desk, capabilities, options_in_cpp(capabilities));
  const std::vector<Eigen::Vector3d> path = intended_path(page);
  SimulatedDevice device(capabilities, GripImpedance(), desk.to_device(path.front()));

  auto capabilities_in_c = profile();
  capabilities_in_c.simulated = 1;
  const auto page_in_c = page_of("永一");
  auto desk_in_c = sized<calligraphy_mapping>();
  REQUIRE(calligraphy_page_mapping(page_in_c.get(), CALLIGRAPHY_DESK, 1.5, &desk_in_c) == CALLIGRAPHY_OK);
  const auto options = options_for(capabilities_in_c, preset, 1.5);
  const auto renderer_in_c = renderer_of(page_in_c.get(), capabilities_in_c, &options, &desk_in_c);
  const Eigen::Vector3d start = desk.to_device(path.front());
  const auto device_in_c = simulated_device(capabilities_in_c, {start.x(), start.y(), start.z()});

  auto tick = sized<calligraphy_tick>();
  auto state = sized<calligraphy_device_state>();
  std::size_t different = 0, pulled = 0;
  std::uint32_t events = 0;
  for (const Eigen::Vector3d& point : path) {
    const Eigen::Vector3d position = desk.to_device(point);
    device.set_intention({position, Eigen::Vector3d::Zero()});
    const HapticTick& expected = renderer.update(device.read());
    device.write(expected.force);
    device.advance(1e-3);
    bool ok = calligraphy_device_intend(device_in_c.get(), position.data(), nullptr) == CALLIGRAPHY_OK;
    ok = ok && calligraphy_device_read(device_in_c.get(), &state) == CALLIGRAPHY_OK;
    ok = ok && calligraphy_renderer_update(renderer_in_c.get(), &state, &tick) == CALLIGRAPHY_OK;
    ok = ok && calligraphy_device_write(device_in_c.get(), tick.force) == CALLIGRAPHY_OK;
    ok = ok && calligraphy_device_advance(device_in_c.get(), 1e-3) == CALLIGRAPHY_OK;
    different += !ok || !same(expected, tick);
    pulled += expected.attraction.norm() > 0.1;
    events |= tick.events;
  }
  CHECK(different == 0);
  CHECK(pulled > (preset == CALLIGRAPHY_PRESET_WANG2006 ? 20 : 1000));
  if (preset != CALLIGRAPHY_PRESET_WANG2006) CHECK((events & CALLIGRAPHY_PAGE_FINISHED) != 0);
}

TEST_CASE("a servo in virtual time writes the forces of a servo in C++") {
  const PracticePage page = page_in_cpp(U"永");
  const MotionMapping upright = upright_page(page.width, page.height);
  const Capabilities capabilities = device_profile("touch");
  HapticRenderer renderer(page.characters, upright, capabilities, RendererOptions::for_device(capabilities));
  const std::vector<Eigen::Vector3d> path = intended_path(page);
  const Eigen::Vector3d start = upright.to_device(path.front());
  SimulatedDevice device(capabilities, GripImpedance(), start);
  ServoOptions options;
  options.work_clock = []() noexcept { return 0.0; };
  Servo servo(device, renderer, options);

  const auto capabilities_in_c = profile("touch");
  const auto page_in_c = page_of("永");
  auto renderer_in_c = renderer_of(page_in_c.get(), capabilities_in_c);
  auto device_in_c = simulated_device(capabilities_in_c, {start.x(), start.y(), start.z()});
  auto servo_in_c = servo_of(device_in_c.get(), renderer_in_c.get());

  auto tick = sized<calligraphy_tick>();
  auto state = sized<calligraphy_device_state>();
  std::size_t different = 0;
  const auto step = [&](std::size_t i) {
    const Eigen::Vector3d position = upright.to_device(path[i]);
    const double now = 1e-3 * static_cast<double>(i);
    device.set_intention({position, Eigen::Vector3d::Zero()});
    servo.step(now);
    device.advance(1e-3);
    bool ok = calligraphy_device_intend(device_in_c.get(), position.data(), nullptr) == CALLIGRAPHY_OK;
    ok = ok && calligraphy_servo_step(servo_in_c.get(), now, &tick) == CALLIGRAPHY_OK;
    ok = ok && calligraphy_device_advance(device_in_c.get(), 1e-3) == CALLIGRAPHY_OK;
    ok = ok && calligraphy_device_read(device_in_c.get(), &state) == CALLIGRAPHY_OK;
    // The tick is the renderer's, but for the force, which is the device's.
    HapticTick expected = renderer.last();
    expected.force = device.read().force;
    expected.page_force = upright.force_to_page(expected.force);
    different += !ok || !same(expected, tick) || !same(expected.force, state.force);
  };
  for (std::size_t i = 0; i < path.size(); ++i) step(i);
  CHECK(different == 0);
  CHECK((tick.character == 1 || tick.stroke == 5));
  auto servo_state = sized<calligraphy_servo_state>();
  REQUIRE(calligraphy_servo_read_state(servo_in_c.get(), &servo_state) == CALLIGRAPHY_OK);
  CHECK(servo_state.phase == CALLIGRAPHY_SERVO_RUNNING);
  CHECK(servo_state.ticks == path.size());
  CHECK(servo_state.missed == 0);
  CHECK(servo_state.fault == std::string());

  SECTION("and ramps down once it is released, whatever else was freed") {
    const Owned<calligraphy_renderer> freed_first = std::move(renderer_in_c);
    REQUIRE(calligraphy_servo_release(servo_in_c.get()) == CALLIGRAPHY_OK);
    for (int i = 0; i < 20; ++i) {
      const double now = 1e-3 * static_cast<double>(path.size() + static_cast<std::size_t>(i));
      REQUIRE(calligraphy_servo_step(servo_in_c.get(), now, nullptr) == CALLIGRAPHY_OK);
    }
    REQUIRE(calligraphy_servo_read_state(servo_in_c.get(), &servo_state) == CALLIGRAPHY_OK);
    CHECK(servo_state.phase == CALLIGRAPHY_SERVO_ZERO);
  }
  SECTION("and leaves no force behind when it is freed") {
    const double deep[3] = {0.0, 0.0, -0.01};
    REQUIRE(calligraphy_renderer_restart(renderer_in_c.get()) == CALLIGRAPHY_OK);
    REQUIRE(calligraphy_device_intend(device_in_c.get(), deep, nullptr) == CALLIGRAPHY_OK);
    for (std::size_t i = path.size(); i < path.size() + 300; ++i) {
      REQUIRE(calligraphy_servo_step(servo_in_c.get(), 1e-3 * static_cast<double>(i), &tick) == CALLIGRAPHY_OK);
      REQUIRE(calligraphy_device_advance(device_in_c.get(), 1e-3) == CALLIGRAPHY_OK);
    }
    REQUIRE(tick.force[2] > 0.5);
    servo_in_c.reset();
    REQUIRE(calligraphy_device_read(device_in_c.get(), &state) == CALLIGRAPHY_OK);
    CHECK(state.force[2] == 0.0);
  }
}

TEST_CASE("a pointer device follows the pointer on the page, at any scale") {
  const double scale = GENERATE(1.0, 2.0);
  const auto page = page_of("永");
  auto mapping = sized<calligraphy_mapping>();
  REQUIRE(calligraphy_page_mapping(page.get(), CALLIGRAPHY_DESK, scale, &mapping) == CALLIGRAPHY_OK);
  const auto capabilities = profile("ideal");
  calligraphy_device* handle = nullptr;
  REQUIRE(calligraphy_pointer_device_create(&capabilities, nullptr, nullptr, &mapping, &handle) == CALLIGRAPHY_OK);
  const Owned<calligraphy_device> device(handle);
  const MotionMapping desk = desk_page(0.16, 0.12, scale);

  // The same pointer in C++, on the page's own paper.
  PointerOptions options;
  options.paper.linear() = desk.rotation.transpose();
  options.paper.translation() = desk.to_device(Eigen::Vector3d::Zero());
  PointerDevice expected(device_profile("ideal"), {}, options);

  auto state = sized<calligraphy_device_state>();
  for (int i = 0; i < 2000; ++i) {
    const double x = 0.08 + 1e-5 * i, pressure = i < 1000 ? 0.0 : 0.5;
    REQUIRE(calligraphy_device_move_pointer(device.get(), x, 0.05, pressure, 3) == CALLIGRAPHY_OK);
    REQUIRE(calligraphy_device_read(device.get(), &state) == CALLIGRAPHY_OK);
    expected.move(x / scale, 0.05 / scale, pressure, 3);
    const DeviceState there = expected.read();
    REQUIRE(same(there.position, state.position));
  }
  const Eigen::Vector3d on_page = desk.to_page({state.position[0], state.position[1], state.position[2]});
  CHECK(on_page.x() == Approx(0.1).margin(1e-3));  // it lags 60 ms behind a pointer of 10 mm/s
  CHECK(on_page.y() == Approx(0.05).margin(1e-4));
  CHECK(on_page.z() == Approx(-0.0025 * scale).margin(1e-4));
  CHECK(state.buttons == 3);
}

TEST_CASE("a tick through the C interface does not allocate") {
  const auto page = page_of("永");
  const auto capabilities = profile();
  const auto options = options_for(capabilities, CALLIGRAPHY_PRESET_EVERYTHING);
  const auto renderer = renderer_of(page.get(), capabilities, &options);
  const auto device = simulated_device(capabilities);
  const auto servo = servo_of(device.get(), renderer.get());
  const PracticePage in_cpp = page_in_cpp(U"永");
  const MotionMapping upright = upright_page(in_cpp.width, in_cpp.height);
  const std::vector<Eigen::Vector3d> path = intended_path(in_cpp);
  auto tick = sized<calligraphy_tick>();
  auto state = sized<calligraphy_device_state>();
  const double not_finite[3] = {NAN, 0.0, 0.0};
  int failed = 0;
  const std::size_t before = allocations();
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Eigen::Vector3d position = upright.to_device(path[i]);
    failed += calligraphy_device_intend(device.get(), position.data(), nullptr);
    failed += calligraphy_servo_step(servo.get(), 1e-3 * static_cast<double>(i), &tick);
    failed += calligraphy_device_advance(device.get(), 1e-3);
    failed += calligraphy_device_read(device.get(), &state);
    failed += calligraphy_renderer_update(renderer.get(), &state, &tick);
    failed += calligraphy_device_write(device.get(), tick.force);
  }
  // Nor does what is refused within a tick.
  CHECK(calligraphy_renderer_update(nullptr, &state, &tick) == CALLIGRAPHY_INVALID_HANDLE);
  CHECK(calligraphy_device_write(device.get(), not_finite) == CALLIGRAPHY_INVALID_VALUE);
  CHECK(allocations() == before);
  CHECK(failed == 0);
}

TEST_CASE("a tick says where the next stroke begins, and in which direction") {
  const auto page = page_of("永一");
  const auto capabilities = profile();
  const auto renderer = renderer_of(page.get(), capabilities);
  const PracticePage in_cpp = page_in_cpp(U"永一");
  const MotionMapping upright = upright_page(in_cpp.width, in_cpp.height);
  auto tick = sized<calligraphy_tick>();
  auto state = sized<calligraphy_device_state>();
  auto stroke = sized<calligraphy_stroke>();
  int strokes_seen = 0;
  int last = -1;
  for (const Eigen::Vector3d& point : intended_path(in_cpp, 0.1, 0.0)) {
    const Eigen::Vector3d position = upright.to_device(point);
    std::memcpy(state.position, position.data(), sizeof state.position);
    state.time += 1e-3;
    REQUIRE(calligraphy_renderer_update(renderer.get(), &state, &tick) == CALLIGRAPHY_OK);
    if (tick.character < 2 && tick.stroke == (tick.character == 0 ? 5 : 1)) {  // not lifted yet
      REQUIRE(tick.next_start[0] == 0.0);
      REQUIRE(tick.next_direction[0] == 0.0);
    } else if (tick.character < 2) {
      if (const int now = 10 * tick.character + tick.stroke; now != last) {
        last = now;
        ++strokes_seen;
      }
      REQUIRE(calligraphy_page_stroke(page.get(), tick.character, tick.stroke, &stroke) == CALLIGRAPHY_OK);
      REQUIRE(std::memcmp(stroke.start, tick.next_start, sizeof stroke.start) == 0);
      REQUIRE(std::memcmp(stroke.direction, tick.next_direction, sizeof stroke.direction) == 0);
      REQUIRE(tick.next_start[0] == Approx(tick.pen_tip[0] + tick.to_start[0]));
    }
  }
  CHECK(strokes_seen == 6);
  CHECK(tick.character == 2);
  CHECK(tick.next_start[0] == 0.0);
  CHECK(tick.next_direction[0] == 0.0);

  SECTION("and again after a restart") {
    REQUIRE(calligraphy_renderer_restart(renderer.get()) == CALLIGRAPHY_OK);
    state.time += 1e-3;
    REQUIRE(calligraphy_renderer_update(renderer.get(), &state, &tick) == CALLIGRAPHY_OK);
    CHECK(tick.character == 0);
    CHECK(tick.stroke == 0);
  }
}

TEST_CASE("a sample that is not finite is no error but a status of the tick") {
  const auto page = page_of("永");
  const auto renderer = renderer_of(page.get(), profile());
  auto tick = sized<calligraphy_tick>();
  auto state = sized<calligraphy_device_state>();
  state.position[1] = NAN;
  CHECK(calligraphy_renderer_update(renderer.get(), &state, &tick) == CALLIGRAPHY_OK);
  CHECK(tick.status == CALLIGRAPHY_TICK_BAD_SAMPLE);
  CHECK(std::isfinite(tick.force[1]));
  state.position[1] = 0.0;
  state.status = 256;  // none of the enumeration
  CHECK(calligraphy_renderer_update(renderer.get(), &state, &tick) == CALLIGRAPHY_OK);
  CHECK(tick.status == CALLIGRAPHY_TICK_DEVICE_FAULT);
}

TEST_CASE("a tick that fails has no force, whatever it had before") {
  const auto page = page_of("永");
  const auto renderer = renderer_of(page.get(), profile());
  auto tick = sized<calligraphy_tick>();
  auto state = sized<calligraphy_device_state>();
  for (int i = 0; i < 400; ++i) {
    state.time = 1e-3 * i;
    state.position[2] = 2e-3 - 1e-5 * i;
    REQUIRE(calligraphy_renderer_update(renderer.get(), &state, &tick) == CALLIGRAPHY_OK);
  }
  REQUIRE(tick.force[2] > 0.5);
  tick.events = CALLIGRAPHY_CONTACT;
  SECTION("because the renderer is none") {
    CHECK(calligraphy_renderer_update(nullptr, &state, &tick) == CALLIGRAPHY_INVALID_HANDLE);
  }
  SECTION("because the sample is none") {
    CHECK(calligraphy_renderer_update(renderer.get(), nullptr, &tick) == CALLIGRAPHY_INVALID_VALUE);
  }
  CHECK(tick.force[2] == 0.0);
  CHECK(tick.page_force[2] == 0.0);
  CHECK(tick.events == 0);
}

TEST_CASE("every member of a sample arrives") {
  const auto page = page_of("永");
  auto capabilities = profile();
  const auto options = options_for(capabilities, CALLIGRAPHY_PRESET_EVERYTHING);
  const auto renderer = renderer_of(page.get(), capabilities, &options);
  const PracticePage in_cpp = page_in_cpp(U"永");
  HapticRenderer expected(in_cpp.characters, upright_page(in_cpp.width, in_cpp.height), device_profile("desktop"),
                          RendererOptions::everything(device_profile("desktop"), 1.0));
  Random random(3);
  auto tick = sized<calligraphy_tick>();
  auto state = sized<calligraphy_device_state>();
  for (int i = 0; i < 1000; ++i) {
    DeviceState sample;
    sample.time = state.time = 1e-3 * i;
    sample.position = {random.between(-0.02, 0.02), random.between(-0.02, 0.02), random.between(-3e-3, 1e-3)};
    sample.velocity = {random.between(-0.1, 0.1), random.between(-0.1, 0.1), random.between(-0.1, 0.1)};
    sample.force = {random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(0.0, 2.0)};
    sample.force_settling = state.force_settling = random.between(0.0, 2e-3);
    std::memcpy(state.position, sample.position.data(), sizeof state.position);
    std::memcpy(state.velocity, sample.velocity.data(), sizeof state.velocity);
    std::memcpy(state.force, sample.force.data(), sizeof state.force);
    state.has_velocity = state.has_force = 1;
    expected.update(sample);
    REQUIRE(calligraphy_renderer_update(renderer.get(), &state, &tick) == CALLIGRAPHY_OK);
    REQUIRE(same(expected.last(), tick));
  }
  CHECK(tick.energy_given != 0.0);
}

TEST_CASE("a servo drives a device of the program's own") {
  const auto capabilities = profile("omni");
  const auto renderer = renderer_of(page_of("永").get(), capabilities);
  const auto device = host_device(capabilities);
  const auto servo = servo_of(device.get(), renderer.get());

  auto state = sized<calligraphy_device_state>();
  auto tick = sized<calligraphy_tick>();
  auto servo_state = sized<calligraphy_servo_state>();
  int now = 0;
  std::uint32_t events = 0;
  // Presses 4 mm deep from 1 mm above, in half a second.
  const auto step = [&](bool fresh) {
    state.time = 1e-3 * now;
    state.position[2] = std::max(1e-3 - 1e-5 * now, -4e-3);
    if (fresh) REQUIRE(calligraphy_device_supply(device.get(), &state) == CALLIGRAPHY_OK);
    REQUIRE(calligraphy_servo_step(servo.get(), 1e-3 * now++, &tick) == CALLIGRAPHY_OK);
    events |= tick.events;
    REQUIRE(calligraphy_servo_read_state(servo.get(), &servo_state) == CALLIGRAPHY_OK);
  };
  step(false);
  CHECK(tick.force[2] == 0.0);
  CHECK(tick.status == CALLIGRAPHY_TICK_STALE);
  double largest_step = 0.0, last = 0.0;
  for (int i = 0; i < 1000; ++i) {
    step(true);
    largest_step = std::max(largest_step, std::abs(tick.force[2] - last));
    last = tick.force[2];
    if (tick.events != 0) {
      step(false);
      CHECK(tick.events == 0);  // nothing is told twice
    }
  }
  CHECK(servo_state.phase == CALLIGRAPHY_SERVO_RUNNING);
  CHECK(tick.force[2] > 0.5);
  CHECK(tick.page_force[2] == Approx(tick.force[2]));
  CHECK(events == CALLIGRAPHY_CONTACT);
  events = 0;
  CHECK(largest_step < 0.1);

  SECTION("and takes the force away when samples stay out") {
    for (int i = 0; i < 20; ++i) {
      step(false);
      CHECK(tick.status == CALLIGRAPHY_TICK_STALE);
    }
    CHECK(tick.force[2] == 0.0);
    CHECK(tick.page_force[2] == 0.0);
    CHECK(servo_state.fault == std::string("silent"));
    CHECK(events == 0);
  }
  SECTION("and takes the force away when samples stay out after one that told of warm motors") {
    state.status = CALLIGRAPHY_DEVICE_WARM_MOTORS;
    step(true);
    CHECK(tick.force[2] > 0.5);
    CHECK(servo_state.advice == std::string(advice_text(DeviceStatus::warm_motors)));
    for (int i = 0; i < 20; ++i) step(false);
    CHECK(tick.force[2] == 0.0);
    CHECK(servo_state.fault == std::string("silent"));
  }
  SECTION("and says that a sample is bad") {
    state.position[0] = not_a_number;
    for (int i = 0; i < 20; ++i) step(true);
    CHECK(tick.status == CALLIGRAPHY_TICK_BAD_SAMPLE);
    CHECK(tick.force[2] == 0.0);
  }
  SECTION("and counts the steps that were missed") {
    now += 3;
    step(true);
    CHECK(servo_state.missed == 3);
  }
  SECTION("and ramps the force up in the beginning") {
    REQUIRE(calligraphy_renderer_restart(renderer.get()) == CALLIGRAPHY_OK);
    const auto another = servo_of(device.get(), renderer.get());
    for (int i = 0; i < 100; ++i) {
      state.time = 1e-3 * now;
      REQUIRE(calligraphy_device_supply(device.get(), &state) == CALLIGRAPHY_OK);
      REQUIRE(calligraphy_servo_step(another.get(), 1e-3 * now++, &tick) == CALLIGRAPHY_OK);
    }
    CHECK(tick.normal > 0.5);  // 100 ms after contact, half of the ramp
    CHECK(tick.force[2] == Approx(0.5 * tick.normal).margin(0.1));
  }
  SECTION("and commands none in a step that fails") {
    CHECK(calligraphy_servo_step(servo.get(), not_a_number, &tick) == CALLIGRAPHY_INVALID_VALUE);
    CHECK(tick.force[2] == 0.0);
    step(true);
    REQUIRE(tick.force[2] > 0.0);
    CHECK(calligraphy_servo_step(nullptr, 1.0, &tick) == CALLIGRAPHY_INVALID_HANDLE);
    CHECK(tick.force[2] == 0.0);
  }
  SECTION("and when the device reports a fault") {
    state.status = CALLIGRAPHY_DEVICE_FAULT;
    for (int i = 0; i < 20; ++i) {
      step(true);
      CHECK(tick.status == CALLIGRAPHY_TICK_DEVICE_FAULT);
    }
    CHECK(tick.force[2] == 0.0);
    CHECK(events == 0);
    CHECK(servo_state.device_status == CALLIGRAPHY_DEVICE_FAULT);
  }
  SECTION("and says what to do while the device needs calibration") {
    CHECK(servo_state.advice == std::string());
    state.status = CALLIGRAPHY_DEVICE_NEEDS_CALIBRATION;
    for (int i = 0; i < 20; ++i) step(true);
    CHECK(tick.force[2] == 0.0);
    CHECK(servo_state.advice == std::string(advice_text(DeviceStatus::needs_calibration)));
  }
}

TEST_CASE("the force for a device of the program's own is one that the device can output") {
  auto capabilities = profile("omni");
  capabilities.force_step = 0.25;
  const auto renderer = renderer_of(page_of("永").get(), capabilities);
  const auto device = host_device(capabilities);
  const auto servo = servo_of(device.get(), renderer.get());
  auto state = sized<calligraphy_device_state>();
  auto tick = sized<calligraphy_tick>();
  for (int i = 0; i < 1000; ++i) {
    state.time = 1e-3 * i;
    state.position[2] = std::max(1e-3 - 1e-5 * i, -4e-3);
    REQUIRE(calligraphy_device_supply(device.get(), &state) == CALLIGRAPHY_OK);
    REQUIRE(calligraphy_servo_step(servo.get(), state.time, &tick) == CALLIGRAPHY_OK);
    REQUIRE(tick.force[2] == 0.25 * std::round(tick.force[2] / 0.25));
  }
  CHECK(tick.force[2] >= 0.5);
}

TEST_CASE("a servo of a slow device waits for a sample for two of its periods") {
  auto capabilities = profile("omni");
  capabilities.update_rate = 125.0;
  const auto renderer = renderer_of(page_of("永").get(), capabilities);
  const auto device = host_device(capabilities);
  const auto servo = servo_of(device.get(), renderer.get());
  auto state = sized<calligraphy_device_state>();
  auto tick = sized<calligraphy_tick>();
  auto servo_state = sized<calligraphy_servo_state>();
  for (int i = 0; i < 250; ++i) {
    state.time = 8e-3 * i;
    state.position[2] = std::max(1e-3 - 4e-5 * i, -4e-3);
    if (i < 240) REQUIRE(calligraphy_device_supply(device.get(), &state) == CALLIGRAPHY_OK);
    REQUIRE(calligraphy_servo_step(servo.get(), state.time, &tick) == CALLIGRAPHY_OK);
    REQUIRE(calligraphy_servo_read_state(servo.get(), &servo_state) == CALLIGRAPHY_OK);
    if (i == 239 || i == 241) CHECK(servo_state.phase == CALLIGRAPHY_SERVO_RUNNING);
    if (i == 241) CHECK(tick.force[2] > 0.1);
  }
  CHECK(tick.force[2] == 0.0);
  CHECK(servo_state.fault == std::string("silent"));
}

TEST_CASE("a hint has the words of C++") {
  auto tick = sized<calligraphy_tick>();
  tick.hint = CALLIGRAPHY_HINT_TOO_FAR;
  tick.to_start[0] = -0.012;
  char text[128];
  REQUIRE(calligraphy_hint_text(&tick, nullptr, text, sizeof text) == CALLIGRAPHY_OK);
  CHECK(text == hint_text(WritingHint::too_far, {-0.012, 0.0}));
  REQUIRE(calligraphy_hint_text(&tick, "zh", text, sizeof text) == CALLIGRAPHY_OK);
  CHECK(text == hint_text(WritingHint::too_far, {-0.012, 0.0}, Language("zh")));
  REQUIRE(calligraphy_hint_text(&tick, "en", text, sizeof text) == CALLIGRAPHY_OK);
  CHECK(calligraphy_hint_text(&tick, nullptr, text, std::strlen(text)) == CALLIGRAPHY_TOO_SMALL);
  CHECK(calligraphy_hint_text(&tick, nullptr, text, std::strlen(text) + 1) == CALLIGRAPHY_OK);
  char small[8] = "before";
  CHECK(calligraphy_hint_text(&tick, nullptr, small, sizeof small) == CALLIGRAPHY_TOO_SMALL);
  CHECK(small == std::string("before"));
  tick.hint = CALLIGRAPHY_HINT_NONE;
  REQUIRE(calligraphy_hint_text(&tick, nullptr, text, 1) == CALLIGRAPHY_OK);
  CHECK(text == std::string());
  tick.hint = CALLIGRAPHY_HINT_AT_END;
  tick.to_start[0] = 1e300;
  REQUIRE(calligraphy_hint_text(&tick, nullptr, text, sizeof text) == CALLIGRAPHY_OK);
  CHECK(text == std::string("at the stroke's end: the start is 1000000000 mm to the right"));
}
