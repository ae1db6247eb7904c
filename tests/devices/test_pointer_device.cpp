#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <string>
#include <thread>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/devices/pointer_device.hpp>

#include "../allocation_counter.hpp"
#include "../catch.hpp"
#include "../special_values.hpp"

using namespace calligraphy;

namespace {

constexpr double pointer_period = 1e-3;  // [s]
using calligraphy_test::infinity;
using calligraphy_test::not_a_number;

std::string error_of(const PointerOptions& options) {
  try {
    PointerDevice device(device_profile("ideal"), {}, options);
  } catch (const ValueError& error) {
    return error.what();
  }
  return {};
}

void reads(PointerDevice& device, int count) {
  for (int i = 0; i < count; ++i) device.read();
}

}  // namespace

TEST_CASE("a pen moves to the pointer, hovers when not pressed and sinks when pressed", "[pointer]") {
  PointerDevice device(device_profile("ideal"));
  CHECK(device.read().position.isApprox(Eigen::Vector3d(0.0, 0.0, 8e-3)));
  device.move(0.02, -0.01, 0.0);
  reads(device, 3000);
  CHECK(device.read().position.isApprox(Eigen::Vector3d(0.02, -0.01, 8e-3), 1e-6));
  device.move(0.02, -0.01, 0.5);
  reads(device, 3000);
  CHECK(device.read().position.z() == Approx(-2.5e-3));
  device.move(0.02, -0.01, 7.0);  // more than full pressure
  reads(device, 3000);
  CHECK(device.read().position.z() == Approx(-5e-3));
  device.move(0.02, -0.01, -1.0);
  reads(device, 3000);
  CHECK(device.read().position.z() == Approx(8e-3));
}

TEST_CASE("a hand that is pushed yields, so the pen is not at the pointer", "[pointer]") {
  PointerDevice device(device_profile("ideal"), {0.1, 3.0, 300.0});
  for (int i = 0; i < 3000; ++i) {
    device.read();
    device.write({0.6, 0.0, 0.0});
  }
  CHECK(device.read().position.x() == Approx(0.6 / 300.0));
}

TEST_CASE("coarse and irregular events become a path of bounded, continuous velocity", "[pointer]") {
  const double rate = GENERATE(60.0, 90.0, 125.0);
  PointerDevice device(device_profile("ideal"));
  const double speed = 0.1;  // [m/s], of the pointer along a circle of 20 mm
  const double radius = 0.02;
  double next_event = 0.0;
  double max_change = 0.0;
  double max_speed_error = 0.0;
  Eigen::Vector3d position = device.intention().position;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  for (int tick = 0; tick < 4000; ++tick) {
    const double time = tick * pointer_period;
    if (time >= next_event) {
      const double angle = speed * time / radius;
      device.move(radius * std::sin(angle), radius * (1.0 - std::cos(angle)), 0.0);
      next_event += (1.0 + 0.3 * std::sin(7.0 * tick)) / rate;  // a third early or late
    }
    device.read();
    const Intention& meant = device.intention();
    // The next line begins where the last one ended.
    REQUIRE((meant.position - (position + velocity * pointer_period)).norm() < 1e-12);
    if (tick > 500) {
      max_change = std::max(max_change, (meant.velocity - velocity).norm());
      max_speed_error = std::max(max_speed_error, std::abs(meant.velocity.norm() - speed));
    }
    position = meant.position;
    velocity = meant.velocity;
  }
  CAPTURE(rate);
  // Without smoothing an event of 60 Hz moves the pen by 1.7 mm within one tick: 1.7 m/s, up and down again.
  CHECK(max_change < 0.12 * speed);
  CHECK(max_speed_error < 0.25 * speed);
}

TEST_CASE("the intention lags by the smoothing time", "[pointer]") {
  PointerOptions options;
  options.smoothing_time = GENERATE(0.0, 0.02, 0.03, 0.1);
  PointerDevice device(device_profile("ideal"), {}, options);
  const double speed = 0.05;  // [m/s]
  for (int tick = 0; tick < 2000; ++tick) {
    device.move(speed * tick * pointer_period, 0.0, 0.0);
    device.read();
  }
  const double late = (1999 * pointer_period * speed - device.intention().position.x()) / speed;
  CHECK(late == Approx(options.smoothing_time).margin(1.1e-3));
}

TEST_CASE("a pointer that jumps is followed at the maximum speed, one that is lifted at the lifting speed",
          "[pointer]") {
  PointerDevice device(device_profile("ideal"));
  device.move(1.0, 0.0, 0.0);
  double fastest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    device.read();
    fastest = std::max(fastest, device.intention().velocity.norm());
  }
  CHECK(fastest == Approx(0.5));
  reads(device, 3000);
  device.move(1.0, 0.0, 1.0);
  fastest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    device.read();
    fastest = std::max(fastest, std::abs(device.intention().velocity.z()));
  }
  CHECK(fastest == Approx(0.12));
}

TEST_CASE("the paper has the position and orientation given in the options", "[pointer]") {
  PointerOptions options;  // flat on a desk: the paper's z is the device's y
  options.paper =
      Eigen::Translation3d(0.01, 0.02, 0.03) * Eigen::AngleAxisd(-0.5 * std::numbers::pi, Eigen::Vector3d::UnitX());
  PointerDevice device(device_profile("ideal"), {}, options);
  CHECK(device.read().position.isApprox(Eigen::Vector3d(0.01, 0.028, 0.03)));
  device.move(0.005, 0.006, 0.5);
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d next = device.intention().position + pointer_period * device.intention().velocity;
    device.read();
    REQUIRE((device.intention().position - next).norm() < 1e-12);
  }
  CHECK(device.read().position.isApprox(Eigen::Vector3d(0.015, 0.0175, 0.024), 1e-6));
}

TEST_CASE("what the pen of a tablet senses is passed on, and does not move the hand", "[pointer]") {
  PointerDevice plain(device_profile("ideal")), sensing(device_profile("ideal"));
  const StylusState stylus = {0.25, 0.5, 1.0, -2.0, 3.0, 0.004};
  plain.move(0.01, 0.02, 0.5);
  sensing.move(0.01, 0.02, 0.5, eraser_button, stylus);
  for (int i = 0; i < 50; ++i) {
    const DeviceState state = sensing.read();
    CHECK(state.position == plain.read().position);
    if (i == 0) continue;  // the sample from before the pointer was taken
    CHECK(state.stylus == stylus);
    CHECK(state.buttons == eraser_button);
  }
}

TEST_CASE("a position or pressure that is not finite is ignored", "[pointer]") {
  const double bad = GENERATE(as<double>{}, not_a_number, infinity, -infinity);
  PointerDevice device(device_profile("ideal"));
  device.move(0.01, 0.0, 0.0, 1);
  device.move(bad, 0.0, 0.0, 2);
  device.move(0.0, bad, 0.0, 2);
  device.move(0.0, 0.0, bad, 2);
  reads(device, 2000);
  CHECK(device.read().position.isApprox(Eigen::Vector3d(0.01, 0.0, 8e-3), 1e-6));
  CHECK(device.read().buttons == 1);
}

TEST_CASE("a closed pointer reports disconnected", "[pointer]") {
  PointerDevice device(device_profile("ideal"));
  device.close();
  CHECK(device.read().status == DeviceStatus::disconnected);
}

TEST_CASE("moving and reading a pointer do not allocate", "[pointer]") {
  PointerDevice device(device_profile("omni"));
  const std::size_t before = calligraphy_test::allocations();
  for (int i = 0; i < 1000; ++i) {
    device.move(1e-5 * i, 0.0, 0.5);
    device.write(-device.read().position);
  }
  const std::size_t after = calligraphy_test::allocations();
  CHECK(after == before);
}

TEST_CASE("positions from another thread arrive intact", "[pointer]") {
  PointerOptions options;
  options.smoothing_time = 0.0;
  options.max_speed = options.lifting_speed = 10.0;
  PointerDevice device(device_profile("ideal"), {}, options);
  std::atomic<bool> done = false;
  std::thread hand([&] {
    for (int i = 0; !done; ++i) device.move(1e-6 * (i % 1000), -1e-6 * (i % 1000), 0.0);
  });
  bool whole = true;
  for (int i = 0; i < 300'000; ++i) {
    device.read();
    const Intention& meant = device.intention();
    whole = whole && std::abs(meant.position.x() + meant.position.y()) < 1e-15;
  }
  done = true;
  hand.join();
  CHECK(whole);
}

TEST_CASE("pointer options out of range are rejected with name and value", "[pointer]") {
  const auto message = [](auto&& change) {
    PointerOptions options;
    change(options);
    return error_of(options);
  };
  CHECK(message([](PointerOptions&) {}).empty());
  CHECK(message([](PointerOptions& o) { o.rate = 50.0; }) == "pointer: rate = 50 Hz, must be from 100 to 100000");
  CHECK(message([](PointerOptions& o) { o.smoothing_time = -1.0; }).find("smoothing_time = -1 s") != std::string::npos);
  CHECK(message([](PointerOptions& o) { o.max_speed = 0.0; }).find("max_speed = 0") != std::string::npos);
  CHECK(message([](PointerOptions& o) { o.lifting_speed = infinity; }).find("lifting_speed = ") != std::string::npos);
  CHECK(message([](PointerOptions& o) { o.hover_height = not_a_number; }).find("hover_height = ") != std::string::npos);
  CHECK(message([](PointerOptions& o) { o.press_depth = 1.0; }).find("press_depth = 1") != std::string::npos);
  CHECK(message([](PointerOptions& o) { o.paper.linear() *= 2.0; }).find("rotation") != std::string::npos);
  CHECK_THROWS_AS(PointerDevice(device_profile("ideal"), {-1.0, 0.0, 0.0}), ValueError);
}
