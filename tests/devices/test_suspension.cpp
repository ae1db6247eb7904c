// A suspended machine is a gap: the hand may be anywhere when it goes on.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include <calligraphy/devices/servo.hpp>
#include <calligraphy/devices/servo_thread.hpp>

#include "../catch.hpp"
#include "base/monotonic_clock.hpp"
#include "suspended_machine.hpp"
#include "watched_device.hpp"

using namespace calligraphy;
using namespace calligraphy_test;

namespace {

struct Pushed {
  Pushed() {
    device.state.velocity.setZero();
    step(300);
    REQUIRE(device.last() == 3.0);
    device.forces.clear();
  }
  void step(int ticks) {
    for (int i = 0; i < ticks; ++i) servo.step(now += 1e-3);
  }

  double now = 100.0;
  WatchedDevice device;
  Servo servo{device, [](const DeviceState&) { return Eigen::Vector3d(3.0, 0.0, 0.0); }};
};

/// Zero within 10 ms, then up again within 0.2 s, never by a step.
void check_down_and_up(const std::vector<Eigen::Vector3d>& forces) {
  REQUIRE(forces.size() == 300);
  const auto zero = std::find_if(forces.begin(), forces.end(), [](const auto& force) { return force.isZero(0.0); });
  CHECK(zero - forces.begin() <= 10);
  CHECK(zero != forces.end());
  for (auto force = forces.begin() + 1; force != forces.end(); ++force) {
    if (force <= zero) CHECK(force->x() <= (force - 1)->x());
    if (force > zero) CHECK((force->x() - (force - 1)->x()) <= 3.0 * 1e-3 / 0.2 + 1e-12);
  }
  CHECK(forces.back().x() == 3.0);
}

}  // namespace

TEST_CASE("after a suspension of 10 s the force ramps down to zero and up again", "[suspension]") {
  Pushed pushed;
  pushed.now += 10.0;
  pushed.step(1);
  CHECK(pushed.servo.status().fault == DeviceFault::late_clock);
  pushed.step(299);
  check_down_and_up(pushed.device.forces);
  CHECK(pushed.servo.statistics().faults[static_cast<std::size_t>(DeviceFault::late_clock)] == 1);
}

TEST_CASE("after a suspension it makes no difference whether the watchdog wakes up first", "[suspension]") {
  Pushed pushed;
  pushed.servo.supervise(100.0);
  pushed.servo.supervise(100.001);
  pushed.now += 10.0;
  pushed.servo.supervise(pushed.now);
  CHECK(pushed.servo.status().fault == DeviceFault::late_clock);
  for (int i = 0; i < 12; ++i) pushed.servo.supervise(pushed.now += 1e-3);
  CHECK(pushed.device.last() == 0.0);
  pushed.step(300 - static_cast<int>(pushed.device.forces.size()));
  check_down_and_up(pushed.device.forces);
}

#if defined(__linux__)

TEST_CASE("the clock of servo loops goes on while the machine is suspended", "[suspension]") {
  const double before = monotonic_seconds();
  const SuspendedMachine suspended(10);
  const double after = monotonic_seconds();
  CHECK(after - before >= 10.0);
}

TEST_CASE("the ticks of a servo thread see a suspension as a gap, and none is caught up", "[suspension]") {
  ServoThreadOptions options;
  options.priority = 0;
  options.lock_memory = false;
  ServoThread thread(1000.0, options);
  std::atomic<double> last = 0.0, gap = 0.0;
  std::atomic<int> ticks = 0, late = 0;
  thread.start([&](double now) {
    if (ticks > 0) gap = std::max(gap.load(), now - last);
    if (ticks > 0 && now - last >= 10.0) ++late;
    last = now;
    ++ticks;
  });
  const auto wait_for = [&](int count) {
    while (ticks < count) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  wait_for(5);
  {
    const SuspendedMachine suspended(1000);
    wait_for(ticks + 5);
    thread.stop();
  }
  CHECK(gap >= 1000.0);
  CHECK(late == 1);
  CHECK(ticks < 1000);  // the grid of 1 kHz has a million deadlines in between
}

#endif
