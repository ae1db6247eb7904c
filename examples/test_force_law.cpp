// Unit tests of your own force law on the simulated device, in virtual time. Copy this file and replace wall(). Link
// calligraphy::devices and Catch2::Catch2WithMain (Catch2 2: Catch2::Catch2, and define CATCH_CONFIG_MAIN).
#include <algorithm>
#include <cmath>

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
#else
#include <catch2/catch.hpp>
#endif

#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/devices/servo.hpp>
#include <calligraphy/devices/simulated_device.hpp>

using namespace calligraphy;

namespace {

/// The law under test: a wall below z = 0, a spring and a damper that never pull [N].
Eigen::Vector3d wall(const DeviceState& state) {
  if (state.position.z() >= 0.0) return Eigen::Vector3d::Zero();
  return {0.0, 0.0, std::max(0.0, -800.0 * state.position.z() - 2.0 * state.velocity.z())};
}

/// In virtual time no law is slow, however busy the machine is that runs the test.
ServoOptions virtual_time() {
  ServoOptions options;
  options.work_clock = []() noexcept { return 0.0; };
  return options;
}

/// Position of the pen after two seconds at 1 kHz, held by a hand that aims at `target` [m], and the maximum force that
/// the law asked for [N], which is not limited as that of the device is.
Eigen::Vector3d pen_at_rest(const GripImpedance& hand, const Eigen::Vector3d& target, double& max_force) {
  SimulatedDevice device(device_profile("desktop"), hand, {0.0, 0.0, 0.01});
  device.set_intention({target, Eigen::Vector3d::Zero()});
  const auto law = [&max_force](const DeviceState& state) {
    const Eigen::Vector3d force = wall(state);
    max_force = std::max(max_force, force.norm());
    return force;
  };
  Servo servo(device, law, virtual_time());
  for (int tick = 0; tick < 2000; ++tick) {
    servo.step(1e-3 * tick);
    CHECK(servo.status().fault == DeviceFault::none);  // as a force that is not finite would be
    device.advance(1e-3);
  }
  return device.true_position();
}

}  // namespace

TEST_CASE("a pressed pen comes to rest where hand and wall balance") {
  const GripImpedance firm{0.15, 5.0, 500.0};
  double max_force = 0.0;
  const Eigen::Vector3d pen = pen_at_rest(firm, {0.0, 0.0, -0.005}, max_force);
  // Two springs; dry friction may stop the pen slightly short of equilibrium.
  CHECK(std::abs(pen.z() + 0.005 * 500.0 / (500.0 + 800.0)) < 2e-4);
  CHECK(max_force < device_profile("desktop").peak_force);
}

TEST_CASE("a device that is unplugged has no force, and gets it back by a ramp") {
  SimulatedDevice device(device_profile("desktop"), {0.15, 5.0, 500.0}, {0.0, 0.0, -0.002});
  device.schedule({{.begin = 0.5, .duration = 0.1, .kind = SimulatedFaultKind::unplugged}});
  Servo servo(device, wall, virtual_time());
  double last = 0.0, max_rise = 0.0;
  for (int tick = 0; tick < 1000; ++tick) {
    servo.step(1e-3 * tick);
    const double force = device.applied_force().z();
    if (tick >= 500 && tick < 600) CHECK(force == 0.0);
    max_rise = std::max(max_rise, force - last);
    last = force;
    device.advance(1e-3);
  }
  CHECK(last > 0.5);
  CHECK(max_rise < 0.05);
}

TEST_CASE("above the wall nothing is felt") {
  double max_force = 0.0;
  pen_at_rest({0.1, 3.0, 300.0}, {0.02, 0.0, 0.01}, max_force);
  CHECK(max_force == 0.0);
}
