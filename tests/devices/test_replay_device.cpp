#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/replay_device.hpp>

#include "../allocation_counter.hpp"
#include "../catch.hpp"

using namespace calligraphy;

namespace {

std::vector<DeviceState> trace(const std::vector<double>& times) {
  std::vector<DeviceState> samples;
  for (const double time : times) {
    DeviceState state;
    state.time = time;
    state.position = {time, 2.0 * time, -time};
    state.buttons = 5;
    state.status = DeviceStatus::warm_motors;
    samples.push_back(state);
  }
  return samples;
}

std::string replay_error(const std::vector<DeviceState>& samples) {
  try {
    ReplayDevice device(samples, {});
  } catch (const ValueError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("a replay returns its samples in order and unchanged", "[devices]") {
  Capabilities capabilities;
  capabilities.model = "recorded";
  std::vector<DeviceState> samples = trace({-1.0, 0.5, 0.75});
  for (DeviceState& sample : samples) {
    sample.velocity = {sample.time, 0.1, 0.2};
    sample.force = {0.0, sample.time, 0.3};
  }
  ReplayDevice device(samples, capabilities);
  CHECK(device.capabilities().model == "recorded");
  for (const double time : {-1.0, 0.5, 0.75}) {
    CHECK_FALSE(device.finished());
    const DeviceState state = device.read();
    CHECK(state.time == time);
    CHECK(state.position == Eigen::Vector3d(time, 2.0 * time, -time));
    CHECK(state.velocity == Eigen::Vector3d(time, 0.1, 0.2));
    CHECK_FALSE(state.velocity_estimated);
    CHECK(state.force == Eigen::Vector3d(0.0, time, 0.3));
    CHECK(state.buttons == 5);
    CHECK(state.status == DeviceStatus::warm_motors);
  }
  CHECK(device.finished());
}

TEST_CASE("a replay estimates velocities that were not recorded, across stale samples but not across faults",
          "[devices]") {
  const Eigen::Vector3d velocity(1.0, 2.0, -1.0);  // of the trace
  std::vector<double> times(200);
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = 5.0 + 1e-3 * static_cast<double>(i);
  std::vector<DeviceState> samples = trace(times);
  samples[100].status = samples[101].status = DeviceStatus::stale;
  samples[100].position = samples[101].position = samples[99].position;
  samples[102].position.x() = std::numeric_limits<double>::quiet_NaN();
  samples[110].velocity.x() = std::numeric_limits<double>::infinity();  // a fault, and NaN along the other axes
  for (std::size_t i = 150; i < samples.size(); ++i) samples[i].position.y() += 1.0;  // while it was unplugged
  samples[149].status = DeviceStatus::disconnected;
  ReplayDevice device(samples, {});
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const DeviceState state = device.read();
    CAPTURE(i, state.velocity.transpose());
    if (i == 110) {
      CHECK(std::isinf(state.velocity.x()));
      continue;
    }
    REQUIRE(state.velocity.allFinite());
    REQUIRE(state.velocity_estimated);
    if (i == 0 || i == 149 || i == 150) REQUIRE(state.velocity.isZero(0.0));
    if (i >= 50 && i < 149) REQUIRE(state.velocity.isApprox(velocity, 1e-6));
    if (i > 150) REQUIRE(state.velocity.norm() < velocity.norm() + 1e-9);
  }
}

TEST_CASE("a replay that has ended reports disconnected at the last position forever", "[devices]") {
  ReplayDevice device(trace({0.0, 0.5}), {});
  device.read();
  device.read();
  for (int i = 0; i < 100; ++i) {
    const DeviceState state = device.read();
    REQUIRE(state.status == DeviceStatus::disconnected);
    REQUIRE(state.position == Eigen::Vector3d(0.5, 1.0, -0.5));
    REQUIRE(state.time == 0.5);
  }
}

TEST_CASE("a closed replay stops at the sample it has reached", "[devices]") {
  ReplayDevice device(trace({1.0, 2.0, 3.0}), {});
  const bool has_read = GENERATE(false, true);
  if (has_read) {
    device.read();
    device.read();
  }
  device.write({1.0, 2.0, 3.0});
  device.close();
  CHECK(device.finished());
  CHECK(device.last_force().isZero(0.0));
  device.write({1.0, 2.0, 3.0});
  CHECK(device.last_force().isZero(0.0));
  CHECK(device.read().status == DeviceStatus::disconnected);
  CHECK(device.read().time == (has_read ? 2.0 : 1.0));
}

TEST_CASE("a replay stores the last force, with a non-finite one as zero", "[devices]") {
  ReplayDevice device(trace({0.0}), {});
  CHECK(device.last_force().isZero(0.0));
  device.write({1.0, -2.0, 30.0});
  CHECK(device.last_force() == Eigen::Vector3d(1.0, -2.0, 30.0));
  device.write({1.0, std::numeric_limits<double>::quiet_NaN(), 0.0});
  CHECK(device.last_force().isZero(0.0));
}

TEST_CASE("a recorded fault is replayed as it was", "[devices]") {
  std::vector<DeviceState> samples = trace({0.0, 1.0});
  samples[0].position.x() = std::numeric_limits<double>::quiet_NaN();
  ReplayDevice device(samples, {});
  CHECK(std::isnan(device.read().position.x()));
}

TEST_CASE("a recording without samples or with times that do not increase is rejected", "[devices]") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  CHECK(replay_error({}).find("no sample") != std::string::npos);
  CHECK(replay_error(trace({0.0, 0.25, 0.25})) ==
        "replay sample 2: time is 0.25 s after 0.25 s, must be finite and increasing");
  CHECK(replay_error(trace({0.0, 0.5, 0.25, 0.75})).find("sample 2") != std::string::npos);
  CHECK(replay_error(trace({std::numeric_limits<double>::quiet_NaN()})).find("sample 0") != std::string::npos);
  CHECK(replay_error(trace({0.0, infinity})).find("sample 1") != std::string::npos);
  CHECK(replay_error(trace({-infinity, 0.0})).find("sample 0") != std::string::npos);
  CHECK(replay_error(trace({0.0})).empty());
}

TEST_CASE("a replay reads and writes without allocating", "[devices]") {
  ReplayDevice device(trace({0.0, 1.0, 2.0}), {});
  const std::size_t before = calligraphy_test::allocations();
  for (int i = 0; i < 6; ++i) {
    device.write(device.read().position);
  }
  device.close();
  const std::size_t after = calligraphy_test::allocations();
  CHECK(after == before);
}
