#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/servo_loop.hpp>

#include "../catch.hpp"
#include "watched_device.hpp"

using namespace calligraphy;
using calligraphy_test::WatchedDevice;

namespace {

/// Waits at most ten seconds for a condition; no test asserts how long it takes.
bool comes(const std::function<bool()>& condition) {
  for (int i = 0; i < 10'000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

Eigen::Vector3d push(const DeviceState&) { return {2.0, 0.0, 0.0}; }

ServoLoopOptions ordinary_thread() {
  ServoLoopOptions options;
  options.thread.priority = 0;
  options.thread.lock_memory = false;
  return options;
}

/// A machine under load may suspend a thread for longer than the default timeout.
ServoLoopOptions patient() {
  ServoLoopOptions options = ordinary_thread();
  options.servo.timeout = 1.0;
  options.servo.ramp_up = 0.0;
  return options;
}

/// Ticks when the test says so.
class SteppedClock final : public ServoClock {
 public:
  void start(std::function<void(double)> tick) override {
    if (refuses) throw DeviceError("no clock today");
    tick_ = std::move(tick);
    for (int i = 0; i < ticks_at_start; ++i) tick_(1e-3 * i);
  }
  void stop() noexcept override { tick_ = nullptr; }
  bool running() const noexcept override { return tick_ != nullptr; }
  void tick(double now) { tick_(now); }
  bool refuses = false;
  int ticks_at_start = 0;  ///< before start() returns

 private:
  std::function<void(double)> tick_;
};

class DeviceWithClock final : public HapticDevice {
 public:
  const Capabilities& capabilities() const noexcept override { return inner.capabilities(); }
  DeviceState read() noexcept override { return inner.read(); }
  void write(const Eigen::Vector3d& force) noexcept override { inner.write(force); }
  void close() noexcept override {}
  ServoClock* clock() noexcept override { return &own_clock; }
  std::vector<std::string> warnings() const override { return {"no watchdog"}; }
  WatchedDevice inner;
  SteppedClock own_clock;
};

}  // namespace

TEST_CASE("after a late tick the next one runs at the next deadline of the grid, and the skipped ones are counted",
          "[servo]") {
  const auto next = [](double deadline, double now) { return next_deadline(deadline, 1.0, now); };
  CHECK(next(10.0, 10.2).time == 11.0);
  CHECK(next(10.0, 10.2).skipped == 0);
  CHECK(next(10.0, 10.999).time == 11.0);
  CHECK(next(10.0, 11.0).time == 12.0);
  CHECK(next(10.0, 11.0).skipped == 1);
  CHECK(next(10.0, 13.5).time == 14.0);
  CHECK(next(10.0, 13.5).skipped == 3);
  CHECK(next(10.0, 9.0).time == 11.0);  // a clock that ran backwards causes no burst either
  for (const double now : {1e3, 1e6 + 0.5, 1e9 + 0.25}) {
    CHECK(next(10.0, now).time > now);
    CHECK(next(10.0, now).time <= now + 1.0);
  }
}

TEST_CASE("a servo thread ticks with a monotonic clock until it is stopped", "[servo]") {
  ServoThreadOptions options;
  options.priority = 0;
  options.lock_memory = false;
  std::vector<double> times;
  times.reserve(100'000);
  std::atomic<int> count = 0;
  ServoThread thread(1000.0, options);  // ends before what it writes to
  thread.start([&](double now) {
    if (times.size() < times.capacity()) times.push_back(now);
    ++count;
  });
  CHECK(thread.running());
  CHECK_THROWS_AS(thread.start([](double) {}), ValueError);
  CHECK(comes([&] { return count >= 20; }));
  thread.stop();
  CHECK_FALSE(thread.running());
  const int after = count;
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  CHECK(count == after);
  CHECK(std::is_sorted(times.begin(), times.end()));
  CHECK(thread.warnings().empty());
  thread.stop();
  thread.start([&](double) { ++count; });
  CHECK(comes([&] { return count > after; }));
}

TEST_CASE("a refused privilege is a warning with a remedy, not an error", "[servo]") {
  ServoThreadOptions options;
  options.priority = 0;
  options.lock_memory = false;
  options.core = 1023;
  ServoThread thread(1000.0, options);
  std::atomic<int> count = 0;
  thread.start([&](double) { ++count; });
  CHECK(comes([&] { return count > 0; }));
  thread.stop();
  REQUIRE(thread.warnings().size() == 1);
  CHECK(thread.warnings()[0].find("1023") != std::string::npos);
  CHECK(thread.warnings()[0].find("choose a core") != std::string::npos);
}

TEST_CASE("requesting real-time priority never prevents a loop from running", "[servo]") {
  WatchedDevice device;
  ServoLoopOptions options = patient();
  options.thread.priority = 50;
  options.thread.lock_memory = true;
  ServoLoop loop(device, push, options);
  std::vector<std::string> warnings = loop.start();
  std::sort(warnings.begin(), warnings.end());
  CHECK(std::unique(warnings.begin(), warnings.end()) == warnings.end());
  for (const std::string& warning : warnings) {
    CHECK(warning.find("may delay the servo loop") != std::string::npos);
    CHECK(warning.find("limits.d") != std::string::npos);
  }
  CHECK(comes([&] { return loop.statistics().ticks > 10; }));
  loop.stop();
}

TEST_CASE("thread options out of range are rejected with name and value", "[servo]") {
  const auto message = [](auto&& change) -> std::string {
    ServoThreadOptions options;
    change(options);
    try {
      ServoThread thread(1000.0, options);
    } catch (const ValueError& error) {
      return error.what();
    }
    return {};
  };
  CHECK(message([](auto& o) { o.priority = 100; }).find("priority = 100") != std::string::npos);
  CHECK(message([](auto& o) { o.priority = -1; }).find("priority = -1") != std::string::npos);
  CHECK(message([](auto& o) { o.core = -2; }).find("core = -2") != std::string::npos);
  CHECK(message([](auto& o) { o.core = 1024; }).find("core = 1024") != std::string::npos);
  CHECK(message([](auto&) {}).empty());
  CHECK_THROWS_WITH(ServoThread(0.0), "servo thread: rate = 0 Hz, must be from 1 to 100000");
  CHECK_THROWS_AS(ServoThread(1000.0).start(nullptr), ValueError);
}

TEST_CASE("a loop writes the desired force, and stopping leaves the force at zero", "[servo]") {
  WatchedDevice device;
  ServoLoop loop(device, push, patient());
  CHECK_FALSE(loop.running());
  loop.start();
  CHECK(loop.running());
  CHECK_THROWS_AS(loop.start(), ValueError);
  CHECK(comes([&] { return loop.status().phase == ServoPhase::running; }));
  CHECK(comes([&] { return loop.statistics().ticks >= 20; }));
  loop.stop();
  CHECK_FALSE(loop.running());
  REQUIRE(device.forces.size() > 10);
  CHECK(device.forces.back().isZero(0.0));
  CHECK(std::any_of(device.forces.begin(), device.forces.end(),  // ramped down, not cut off
                    [](const Eigen::Vector3d& force) { return force.x() > 0.0 && force.x() < 2.0; }));
  CHECK(loop.status().phase == ServoPhase::zero);
  const std::uint64_t ticks = loop.statistics().ticks;
  CHECK(loop.statistics().period.count <= ticks);
  CHECK(loop.statistics().work.count == ticks);

  loop.start();
  CHECK(comes([&] { return loop.status().phase == ServoPhase::running; }));
  CHECK(loop.statistics().ticks > ticks);
}

TEST_CASE("destroying a loop stops it", "[servo]") {
  WatchedDevice device;
  {
    ServoLoop loop(device, push, patient());
    loop.start();
    CHECK(comes([&] { return loop.status().phase == ServoPhase::running; }));
  }
  CHECK(device.last() == 0.0);
}

TEST_CASE("the watchdog takes over the device from a force law that hangs in the loop's own thread", "[servo]") {
  WatchedDevice device;
  std::atomic<bool> hang = false;
  std::atomic<bool> hangs = false;
  ServoLoopOptions options = patient();
  options.servo.timeout = 0.05;
  ServoLoop loop(
      device,
      [&](const DeviceState& state) {
        while (hang) {
          hangs = true;
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return push(state);
      },
      options);
  loop.start();
  CHECK(comes([&] { return loop.status().phase == ServoPhase::running; }));
  hang = true;
  CHECK(comes([&] {
    const ServoStatus status = loop.status();
    return hangs && status.phase == ServoPhase::zero && status.fault == DeviceFault::slow_force_law;
  }));
  CHECK(loop.statistics().fault_count(DeviceFault::slow_force_law) >= 1);
  hang = false;
  CHECK(comes([&] { return loop.status().phase == ServoPhase::running; }));
  loop.stop();
  CHECK(device.last() == 0.0);
  CHECK_FALSE(device.touched_by_two);
}

TEST_CASE("a loop stopped from within its force law ramps the force down, and ends when it is stopped from outside",
          "[servo]") {
  WatchedDevice device;
  ServoLoop* itself = nullptr;
  std::atomic<int> asked = 0;
  ServoLoop loop(
      device,
      [&](const DeviceState& state) {
        if (++asked == 20) itself->stop();
        return push(state);
      },
      patient());
  itself = &loop;
  loop.start();
  REQUIRE(comes([&] { return asked >= 20 && loop.status().phase == ServoPhase::zero; }));
  CHECK(loop.running());
  loop.stop();
  CHECK(!loop.running());
  CHECK(asked == 20);
  CHECK(device.last() == 0.0);
}

TEST_CASE("a stop from within the force law before start() has returned takes effect", "[servo]") {
  DeviceWithClock device;
  device.own_clock.ticks_at_start = 3;
  ServoLoop* itself = nullptr;
  int asked = 0;
  bool was_running = false;
  ServoLoop loop(
      device,
      [&](const DeviceState& state) {
        ++asked;
        was_running = itself->running();
        itself->stop();
        return push(state);
      },
      patient());
  itself = &loop;
  loop.start();
  CHECK(asked == 1);
  CHECK(was_running);
  CHECK(loop.running());  // until it is stopped from outside
  for (int i = 3; i < 20; ++i) device.own_clock.tick(1e-3 * i);
  CHECK(asked == 1);
  CHECK(loop.status().phase == ServoPhase::zero);
  CHECK(device.inner.last() == 0.0);
  loop.stop();
  CHECK_FALSE(loop.running());
}

TEST_CASE("a stop in the first call of the force law takes effect however the threads are scheduled", "[servo]") {
  for (int run = 0; run < 50; ++run) {
    WatchedDevice device;
    std::atomic<ServoLoop*> itself = nullptr;
    std::atomic<int> asked = 0;
    ServoLoopOptions options = patient();
    options.servo.rate = 10'000.0;
    ServoLoop loop(
        device,
        [&](const DeviceState& state) {
          ++asked;
          itself.load()->stop();
          return push(state);
        },
        options);
    itself = &loop;
    loop.start();
    REQUIRE(comes([&] { return loop.statistics().ticks >= 5; }));
    REQUIRE(asked == 1);
    REQUIRE(comes([&] { return loop.status().phase == ServoPhase::zero; }));
    loop.stop();
    REQUIRE(device.last() == 0.0);
  }
}

TEST_CASE("two loops run two devices at once", "[servo]") {
  WatchedDevice left;
  WatchedDevice right;
  right.state.status = DeviceStatus::disconnected;
  ServoLoop first(left, push, patient());
  ServoLoop second(right, push, patient());
  first.start();
  second.start();
  CHECK(comes([&] { return first.statistics().ticks > 20 && second.statistics().ticks > 20; }));
  CHECK(first.status().fault == DeviceFault::none);
  CHECK(second.status().fault == DeviceFault::unplugged);
  second.stop();
  const std::uint64_t ticks = first.statistics().ticks;
  CHECK(comes([&] { return first.statistics().ticks > ticks; }));
  first.stop();
  for (const Eigen::Vector3d& force : right.forces) REQUIRE(force.isZero(0.0));
}

TEST_CASE("a device with its own clock is clocked only by it", "[servo]") {
  DeviceWithClock device;
  ServoLoop loop(device, push, patient());
  loop.start();
  CHECK(device.own_clock.running());
  for (int i = 1; i <= 10; ++i) device.own_clock.tick(1e-3 * i);
  CHECK(loop.statistics().ticks == 10);
  CHECK(device.inner.last() == 2.0);
  loop.stop();  // this clock has stopped: the wait for the ramp-down is bounded, and the force still ends at zero
  CHECK_FALSE(device.own_clock.running());
  CHECK(device.inner.last() == 0.0);
}

TEST_CASE("warnings are told before the first tick, without which the loop does not start", "[servo]") {
  DeviceWithClock device;
  device.own_clock.ticks_at_start = 3;
  ServoLoop loop(device, push, patient());
  std::vector<std::string> told;
  CHECK_THROWS_AS(loop.start([](const std::vector<std::string>&) { throw ValueError("not now"); }), ValueError);
  CHECK_FALSE(loop.running());
  CHECK_FALSE(device.own_clock.running());
  loop.start([&](const std::vector<std::string>& warnings) {
    told = warnings;
    CHECK(loop.statistics().ticks == 0);
  });
  CHECK(told == device.warnings());
  device.own_clock.tick(3e-3);
  CHECK(device.inner.last() == 2.0);

  WatchedDevice without_clock;
  ServoLoop another(without_clock, push, patient());
  another.start([&](const std::vector<std::string>&) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    CHECK(another.statistics().ticks == 0);
  });
  CHECK(comes([&] { return another.statistics().ticks > 0; }));
}

TEST_CASE("a clock that cannot be started leaves the loop stopped", "[servo]") {
  DeviceWithClock device;
  device.own_clock.refuses = true;
  ServoLoop loop(device, push, patient());
  CHECK_THROWS_AS(loop.start(), DeviceError);
  CHECK_FALSE(loop.running());
  device.own_clock.refuses = false;
  loop.start();
  CHECK(loop.running());
}
