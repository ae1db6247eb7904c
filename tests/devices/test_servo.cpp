#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/random.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/devices/servo.hpp>
#include <calligraphy/devices/simulated_device.hpp>

#include "../allocation_counter.hpp"
#include "../catch.hpp"
#include "../special_values.hpp"
#include "../still_clock.hpp"
#include "watched_device.hpp"

using namespace calligraphy;
using calligraphy_test::WatchedDevice;

namespace {

constexpr double period = 1e-3;  // [s]
constexpr double wanted = 2.0;   // [N]
using calligraphy_test::infinity;
using calligraphy_test::not_a_number;

double virtual_time = 0.0;  // [s]
double virtual_clock() noexcept { return virtual_time; }

/// A servo with its device, its clock and its watchdog, all in virtual time.
struct Bench {
  explicit Bench(ServoOptions options = {})
      : servo(
            device, [this](const DeviceState& s) { return law(s); }, timed(options)) {
    virtual_time = 0.0;
  }

  static ServoOptions timed(ServoOptions options) {
    options.work_clock = virtual_clock;
    return options;
  }

  void tick() {
    virtual_time += period;
    servo.step(virtual_time);
    servo.supervise(virtual_time);
  }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) tick();
  }
  /// Advances time with only the watchdog running.
  void wait(int milliseconds) {
    for (int i = 0; i < milliseconds; ++i) {
      virtual_time += 1e-3;
      servo.supervise(virtual_time);
    }
  }
  /// Runs until the ramp-up is complete.
  void warm_up() {
    ticks(250);
    REQUIRE(servo.status().phase == ServoPhase::running);
    REQUIRE(device.last() == wanted);
    device.forces.clear();
  }

  WatchedDevice device;
  std::function<Eigen::Vector3d(const DeviceState&)> law = [](const DeviceState&) {
    return Eigen::Vector3d(wanted, 0.0, 0.0);
  };
  Servo servo;
};

/// The forces of a ramp-down in ticks of 1 ms: nine tenths, eight tenths, ... zero.
void check_fall(const std::vector<Eigen::Vector3d>& forces, std::size_t first = 0) {
  REQUIRE(forces.size() >= first + 10);
  for (std::size_t i = 0; i < 10; ++i) {
    CAPTURE(i);
    CHECK(forces[first + i].x() == Approx(wanted * (0.9 - 0.1 * static_cast<double>(i))).margin(1e-12));
  }
  CHECK(forces[first + 9].isZero(0.0));
}

double max_step(const std::vector<Eigen::Vector3d>& forces, double before) {
  double largest = 0.0;
  for (const Eigen::Vector3d& force : forces) {
    largest = std::max(largest, std::abs(force.x() - before));
    before = force.x();
  }
  return largest;
}

/// After recovery the force ramps up from zero by 1/200 per tick.
void check_return(Bench& bench) {
  const double before = bench.device.last();
  CHECK(before <= wanted * 0.151);
  bench.device.forces.clear();
  bench.ticks(250);
  CHECK(max_step(bench.device.forces, before) <= wanted * 1.001 / 200.0);
  CHECK(bench.device.last() == wanted);
  CHECK(bench.servo.status().phase == ServoPhase::running);
  CHECK(bench.servo.status().fault == DeviceFault::none);
}

std::string error_of(const ServoOptions& options) {
  WatchedDevice device;
  try {
    Servo servo(
        device, [](const DeviceState&) { return Eigen::Vector3d::Zero().eval(); }, options);
  } catch (const ValueError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("a servo starts with zero force and ramps up linearly to the desired force", "[servo]") {
  Bench bench;
  bench.ticks(199);
  for (std::size_t i = 0; i < 199; ++i) {
    CHECK(bench.device.forces[i].x() == Approx(wanted * static_cast<double>(i + 1) / 200.0));
  }
  CHECK(bench.servo.status().phase == ServoPhase::rising);
  bench.ticks(2);
  CHECK(bench.device.last() == wanted);
  CHECK(bench.servo.status().phase == ServoPhase::running);
}

TEST_CASE("the force law sees each fresh sample once, and its force is written in the same tick", "[servo]") {
  Bench bench;
  bench.warm_up();
  int calls = 0;
  bench.law = [&](const DeviceState& state) {
    ++calls;
    return Eigen::Vector3d(0.0, state.position.y(), 0.0);
  };
  for (int i = 1; i <= 10; ++i) {
    bench.device.state.position.y() = i;
    bench.tick();
    CHECK(bench.device.forces.back() == Eigen::Vector3d(0.0, i, 0.0));
  }
  CHECK(calls == 10);
}

TEST_CASE("for an unusable device the force ramps down to zero in 10 ms, and the fault is reported", "[servo]") {
  struct Case {
    DeviceStatus status;
    DeviceFault reason, named;
  };
  const Case each = GENERATE(Case{DeviceStatus::disconnected, DeviceFault::none, DeviceFault::unplugged},
                             Case{DeviceStatus::disconnected, DeviceFault::link_error, DeviceFault::link_error},
                             Case{DeviceStatus::needs_calibration, DeviceFault::none, DeviceFault::uncalibrated},
                             Case{DeviceStatus::fault, DeviceFault::none, DeviceFault::device_error},
                             Case{DeviceStatus::fault, DeviceFault::stalled, DeviceFault::stalled},
                             Case{DeviceStatus::fault, DeviceFault::overheated, DeviceFault::overheated});
  CAPTURE(to_string(each.named));
  Bench bench;
  bench.warm_up();
  int calls = 0;
  bench.law = [&](const DeviceState&) {
    ++calls;
    return Eigen::Vector3d(wanted, 0.0, 0.0);
  };
  bench.device.state.status = each.status;
  bench.device.state.fault = each.reason;
  bench.ticks(30);
  check_fall(bench.device.forces);
  CHECK(std::all_of(bench.device.forces.begin() + 9, bench.device.forces.end(),
                    [](const Eigen::Vector3d& force) { return force.isZero(0.0); }));
  CHECK(calls == 0);
  CHECK(bench.servo.status().phase == ServoPhase::zero);
  CHECK(bench.servo.status().fault == each.named);
  CHECK(bench.servo.status().device == each.status);
  CHECK(bench.servo.statistics().fault_count(each.named) == 1);

  bench.device.state = {};
  check_return(bench);
  CHECK(bench.servo.statistics().fault_count(each.named) == 1);
}

TEST_CASE("warm motors do not cause a ramp-down", "[servo]") {
  Bench bench;
  bench.warm_up();
  bench.device.state.status = DeviceStatus::warm_motors;
  bench.ticks(10);
  CHECK(bench.device.last() == wanted);
  CHECK(bench.servo.status().device == DeviceStatus::warm_motors);
}

TEST_CASE("a ramp-down completes even if the fault clears sooner", "[servo]") {
  Bench bench;
  bench.warm_up();
  bench.device.state.status = DeviceStatus::fault;
  bench.tick();
  bench.device.state.status = DeviceStatus::ok;
  bench.ticks(9);
  check_fall(bench.device.forces);
  check_return(bench);
}

TEST_CASE("a fault during ramp-up ramps the force down from its current value", "[servo]") {
  Bench bench;
  bench.ticks(100);
  CHECK(bench.device.last() == Approx(0.5 * wanted));
  bench.device.forces.clear();
  bench.device.state.status = DeviceStatus::fault;
  bench.ticks(10);
  CHECK(bench.device.forces[0].x() == Approx(0.45 * wanted));
  CHECK(bench.device.forces[9].isZero(0.0));
}

TEST_CASE("a stale sample holds the force for 4 ms, and after a longer silence it is zero within 20 ms", "[servo]") {
  Bench bench;
  bench.warm_up();
  int calls = 0;
  bench.law = [&](const DeviceState&) {
    ++calls;
    return Eigen::Vector3d(wanted, 0.0, 0.0);
  };
  bench.device.state.status = DeviceStatus::stale;
  bench.ticks(4);
  CHECK(bench.device.last() == wanted);
  CHECK(calls == 0);
  bench.device.state.status = DeviceStatus::ok;
  bench.tick();
  CHECK(calls == 1);
  CHECK(bench.device.last() == wanted);

  bench.device.forces.clear();
  bench.device.state.status = DeviceStatus::stale;
  const DeviceFault reason = GENERATE(DeviceFault::none, DeviceFault::timed_out);
  bench.device.state.fault = reason;
  bench.ticks(20);
  check_fall(bench.device.forces, 4);
  CHECK(bench.servo.status().fault == (reason == DeviceFault::none ? DeviceFault::silent : reason));
  CHECK(bench.servo.statistics().stale_samples == 24);
  bench.device.state = {};
  check_return(bench);
}

TEST_CASE("an ok sample that is not finite counts as corrupted, and the force law does not see it", "[servo]") {
  const double bad = GENERATE(as<double>{}, not_a_number, infinity, -infinity);
  Bench bench;
  bench.warm_up();
  bench.law = [](const DeviceState& state) { return Eigen::Vector3d(wanted + 0.0 * state.position.z(), 0.0, 0.0); };
  bench.device.state.position.z() = bad;
  bench.ticks(10);
  check_fall(bench.device.forces);
  CHECK(bench.servo.status().fault == DeviceFault::corrupted_frame);
  bench.device.state = {};
  check_return(bench);
}

TEST_CASE("an unmeasured velocity is not a fault, an infinite one is", "[servo]") {
  Bench bench;
  bench.warm_up();
  bench.device.state.velocity.setConstant(not_a_number);
  bench.ticks(10);
  CHECK(bench.device.last() == wanted);
  bench.device.state.velocity.x() = infinity;
  bench.ticks(10);
  CHECK(bench.device.last() == 0.0);
}

TEST_CASE("a velocity that is not measured is estimated, one that is measured is passed on", "[servo]") {
  constexpr double speed = 0.2;
  Bench bench;
  std::vector<DeviceState> seen;
  bench.law = [&seen](const DeviceState& state) -> Eigen::Vector3d {
    seen.push_back(state);
    return {0.0, 0.0, 0.0};
  };
  for (int i = 0; i < 100; ++i) {
    bench.device.state.position.y() += speed * period;
    bench.tick();
  }
  REQUIRE(seen.size() == 100);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const double risen = 1.0 - std::exp(-2.0 * std::numbers::pi * 50.0 * period * static_cast<double>(i));
    REQUIRE(seen[i].velocity.y() == Approx(speed * risen).margin(1e-12));
    REQUIRE(seen[i].velocity_estimated);
  }
  bench.device.state.velocity = {1.0, 2.0, 3.0};
  bench.tick();
  CHECK(seen.back().velocity == Eigen::Vector3d(1.0, 2.0, 3.0));
  CHECK_FALSE(seen.back().velocity_estimated);
}

TEST_CASE("stale samples do not show in an estimated velocity", "[servo]") {
  constexpr double speed = 0.2;
  Bench bench;
  double last = 0.0;
  bench.law = [&last](const DeviceState& state) -> Eigen::Vector3d {
    last = state.velocity.x();
    return {0.0, 0.0, 0.0};
  };
  for (int i = 0; i < 200; ++i) {
    const bool fresh = i < 100 || i % 3 == 0;
    bench.device.state.status = fresh ? DeviceStatus::ok : DeviceStatus::stale;
    if (fresh) bench.device.state.position.x() = speed * period * i;
    bench.tick();
    if (i >= 99) REQUIRE(last == Approx(speed));
  }
}

TEST_CASE("after a fault, a gap or a reset an estimated velocity starts from zero, wherever the pen is by then",
          "[servo]") {
  const int what = GENERATE(0, 1, 2, 3);
  CAPTURE(what);
  Bench bench;
  double last = 0.0, largest = 0.0;
  bench.law = [&](const DeviceState& state) -> Eigen::Vector3d {
    last = state.velocity.x();
    largest = std::max(largest, std::abs(last));
    return {wanted, 0.0, 0.0};
  };
  const auto move = [&](int ticks) {
    for (int i = 0; i < ticks; ++i) {
      bench.device.state.position.x() += 1e-4;
      bench.tick();
    }
  };
  move(100);
  REQUIRE(last == Approx(0.1));
  if (what == 0) {
    bench.device.state.status = DeviceStatus::disconnected;
    bench.tick();
    bench.device.state.status = DeviceStatus::ok;
  } else if (what == 1) {
    bench.wait(200);  // the force is zero by then, so that this gap is no fault
  } else if (what == 2) {
    virtual_time += 5e-3;
  } else {
    bench.servo.reset();
  }
  bench.device.state.position.x() += 0.5;
  bench.tick();
  bench.tick();
  CHECK(last == 0.0);
  move(100);
  CHECK(last == Approx(0.1));
  CHECK(largest < 0.1001);
}

TEST_CASE("the force law sees the force at work: the last one written, whoever wrote it", "[servo]") {
  ServoOptions options;
  Bench bench(options);
  long calls = 0, nonzero = 0;
  bench.law = [&](const DeviceState& state) -> Eigen::Vector3d {
    const Eigen::Vector3d written =
        bench.device.forces.empty() ? Eigen::Vector3d(0.0, 0.0, 0.0) : bench.device.forces.back();
    ++calls;
    if (!written.isZero(0.0)) ++nonzero;
    REQUIRE(state.force == written);
    return {wanted + 1e-3 * static_cast<double>(calls % 7), 0.5, 0.0};
  };
  bench.ticks(250);  // ramps up, and runs
  bench.device.state.position.z() = not_a_number;
  bench.tick();
  bench.device.state.position.z() = 0.0;
  bench.ticks(5);  // ramps down, although the fault has cleared
  CHECK(bench.servo.status().phase == ServoPhase::falling);
  bench.ticks(250);
  CHECK(calls == 505);
  bench.wait(100);  // the watchdog ramps down
  REQUIRE(bench.servo.statistics().watchdog_takeovers == 1);
  REQUIRE(bench.device.forces.back().isZero(0.0));
  bench.tick();
  CHECK(calls == 506);
  CHECK(nonzero > 490);
}

TEST_CASE("a force that the device reports itself is passed on", "[servo]") {
  Bench bench;
  bench.device.state.force = {0.25, 0.5, -1.0};  // its motors are warm, say
  Eigen::Vector3d seen(0.0, 0.0, 0.0);
  bench.law = [&seen](const DeviceState& state) {
    seen = state.force;
    return Eigen::Vector3d(wanted, 0.0, 0.0);
  };
  bench.ticks(10);
  CHECK(seen == bench.device.state.force);
}

TEST_CASE("a force law that throws or returns NaN is counted, and the last good force ramps down", "[servo]") {
  const int kind = GENERATE(0, 1, 2, 3);
  Bench bench;
  bench.warm_up();
  const auto good = bench.law;
  bench.law = [kind](const DeviceState&) -> Eigen::Vector3d {
    if (kind == 0) throw std::runtime_error("no force today");
    if (kind == 1) throw 42;
    return {0.0, kind == 2 ? not_a_number : -infinity, 0.0};
  };
  bench.ticks(15);
  check_fall(bench.device.forces);
  CHECK(bench.servo.status().fault == DeviceFault::bad_force);
  CHECK(bench.servo.statistics().fault_count(DeviceFault::bad_force) == 1);
  bench.law = good;
  check_return(bench);
}

TEST_CASE("a force above the device's peak is limited to it, and one whose norm overflows is a bad force", "[servo]") {
  WatchedDevice device(3.3);
  Eigen::Vector3d asked(1e6, -1e6, 0.0);
  ServoOptions options = Bench::timed({});
  options.ramp_up = 0.0;
  virtual_time = 0.0;
  Servo servo(
      device, [&asked](const DeviceState&) { return asked; }, options);
  const auto tick = [&servo] { servo.step(virtual_time += period); };
  for (int i = 0; i < 5; ++i) tick();
  CHECK(device.forces.back().isApprox(3.3 * Eigen::Vector3d(1.0, -1.0, 0.0).normalized(), 1e-12));
  asked = {1.0, 2.0, -2.0};
  tick();
  CHECK(device.forces.back() == asked);
  asked = {1e300, 1e300, 0.0};
  for (int i = 0; i < 12; ++i) tick();
  CHECK(device.forces.back().isZero(0.0));
  CHECK(servo.status().fault == DeviceFault::bad_force);
}

TEST_CASE("the force of a law that takes longer than the timeout is not written", "[servo]") {
  Bench bench;
  bench.warm_up();
  const auto good = bench.law;
  bench.law = [](const DeviceState&) {
    virtual_time += 4.5e-3;
    return Eigen::Vector3d(100.0, 0.0, 0.0);
  };
  bench.ticks(10);  // without the watchdog
  CHECK(bench.device.forces[0].x() == Approx(0.9 * wanted));
  CHECK(std::all_of(bench.device.forces.begin(), bench.device.forces.end(),
                    [](const Eigen::Vector3d& force) { return force.x() < wanted; }));
  CHECK(bench.device.last() == 0.0);
  CHECK(bench.servo.status().fault == DeviceFault::slow_force_law);
  bench.law = good;
  bench.tick();  // the clock has jumped again, while the force is zero
  check_return(bench);
}

TEST_CASE("the watchdog takes over the device from a hung force law, and the force is zero within 20 ms", "[servo]") {
  Bench bench;
  bench.warm_up();
  const auto good = bench.law;
  double zero_after = infinity;
  bench.law = [&](const DeviceState&) {
    const double begun = virtual_time;
    for (int i = 0; i < 100; ++i) {
      bench.wait(1);
      if (bench.device.last() == 0.0 && !bench.device.forces.empty()) {
        zero_after = std::min(zero_after, virtual_time - begun);
      }
    }
    return Eigen::Vector3d(100.0, 0.0, 0.0);
  };
  bench.tick();
  check_fall(bench.device.forces);
  CHECK(bench.device.forces.size() == 10);  // written to by neither the watchdog nor the late tick
  CHECK(zero_after <= 0.016 + 1e-9);
  CHECK(bench.servo.status().phase == ServoPhase::zero);
  CHECK(bench.servo.status().fault == DeviceFault::slow_force_law);
  const ServoStatistics statistics = bench.servo.statistics();
  CHECK(statistics.watchdog_takeovers == 1);
  CHECK(statistics.idle_ticks == 1);
  CHECK(statistics.fault_count(DeviceFault::slow_force_law) == 1);
  bench.law = good;
  check_return(bench);
  CHECK(bench.servo.statistics().fault_count(DeviceFault::late_clock) == 0);
  CHECK_FALSE(bench.device.touched_by_two);
}

TEST_CASE("a force law that returns while the watchdog ramps the force down writes nothing", "[servo]") {
  Bench bench;
  bench.warm_up();
  const auto good = bench.law;
  bench.law = [&](const DeviceState&) {
    bench.wait(9);  // taken over after 5; four of the ten steps of the ramp-down are done
    return Eigen::Vector3d(100.0, 0.0, 0.0);
  };
  bench.servo.step(virtual_time += period);
  bench.law = good;
  const long reads = bench.device.reads;
  for (int i = 0; i < 3; ++i) bench.tick();  // the watchdog has the device
  CHECK(bench.device.reads == reads);
  CHECK(bench.servo.statistics().idle_ticks == 4);
  bench.ticks(3);
  check_fall(bench.device.forces);
  check_return(bench);
}

TEST_CASE("ticks continue the ramp of a watchdog that is called no more, and say how long a force acted unseen",
          "[servo]") {
  Bench bench;
  bench.warm_up();
  bench.wait(8);  // taken over after 5; some of the ten steps of the ramp-down are done
  REQUIRE(bench.servo.status().phase == ServoPhase::falling);
  const double left = bench.device.last();
  double settling = -1.0;
  bench.law = [&](const DeviceState& state) {
    if (settling < 0.0) settling = state.force_settling;
    CHECK(state.force.x() == bench.device.last());
    return Eigen::Vector3d(wanted, 0.0, 0.0);
  };
  for (int i = 0; i < 2; ++i) bench.servo.step(virtual_time += period);
  CHECK(bench.device.last() == Approx(left - 0.1 * wanted));  // the first tick has waited for the watchdog
  CHECK(settling == Approx(10e-3));                           // the watchdog has not watched since its last write
  for (int i = 0; i < 10; ++i) bench.servo.step(virtual_time += period);
  check_fall(bench.device.forces);
  CHECK(bench.servo.statistics().fault_count(DeviceFault::late_clock) == 1);
  CHECK(bench.servo.statistics().watchdog_takeovers == 1);
}

TEST_CASE("a force that the watchdog removed late is known to have acted until then", "[servo]") {
  Bench bench;
  bench.warm_up();
  double settling = 0.0;
  bench.law = [&](const DeviceState& state) {
    settling = state.force_settling;
    return Eigen::Vector3d(wanted, 0.0, 0.0);
  };
  bench.tick();
  CHECK(settling == 0.0);
  virtual_time += 0.1;  // nobody comes
  bench.wait(2);
  virtual_time += 0.1;
  bench.wait(10);
  REQUIRE(bench.device.last() == 0.0);
  bench.tick();
  CHECK(settling == Approx(0.204));  // 203 ms, and the period up to this tick
}

TEST_CASE("when the clock stops, the watchdog ramps the force down once, and the loop resumes when ticks return",
          "[servo]") {
  Bench bench;
  bench.warm_up();
  bench.wait(16);
  check_fall(bench.device.forces);
  CHECK(bench.servo.status().fault == DeviceFault::late_clock);
  bench.wait(1000);
  CHECK(bench.device.forces.size() == 10);
  CHECK(bench.servo.statistics().watchdog_takeovers == 1);
  CHECK(bench.servo.statistics().fault_count(DeviceFault::late_clock) == 1);
  check_return(bench);
  CHECK(bench.servo.statistics().fault_count(DeviceFault::late_clock) == 1);
}

TEST_CASE("the watchdog does not interfere with a loop that ticks as slowly as its timeout allows", "[servo]") {
  Bench bench;
  bench.warm_up();
  for (int i = 0; i < 100; ++i) {
    bench.wait(3);
    bench.tick();
  }
  CHECK(bench.servo.statistics().watchdog_takeovers == 0);
  CHECK(bench.device.last() == wanted);
}

TEST_CASE("nothing touches a device whose read hangs, and the status is timed out", "[servo]") {
  Bench bench;
  bench.warm_up();
  bench.device.while_reading = [&] {
    bench.wait(100);
    CHECK(bench.device.forces.empty());
    CHECK(bench.servo.status().fault == DeviceFault::timed_out);
    CHECK(bench.servo.status().phase == ServoPhase::running);
  };
  bench.tick();
  CHECK(bench.servo.statistics().fault_count(DeviceFault::timed_out) == 1);
  CHECK(bench.servo.statistics().watchdog_takeovers == 0);
  CHECK_FALSE(bench.device.touched_by_two);
  bench.device.while_reading = nullptr;
  bench.ticks(15);  // long enough without a tick to be a late clock once the device responds again
  CHECK(bench.servo.statistics().fault_count(DeviceFault::late_clock) == 1);
  check_return(bench);
}

TEST_CASE("a clock jump ramps the force down without a force step", "[servo]") {
  const double leap = GENERATE(4.6e-3, 0.1, 3600.0, 1e6);
  Bench bench;
  bench.warm_up();
  double now = virtual_time + leap;
  for (int i = 0; i < 10; ++i) bench.servo.step(now += period);
  check_fall(bench.device.forces);
  CHECK(bench.servo.statistics().fault_count(DeviceFault::late_clock) == 1);
}

TEST_CASE("with a clock that stalls, runs backwards or returns NaN each tick counts as one period", "[servo]") {
  const double step = GENERATE(as<double>{}, 0.0, -1e-3, -1e9, not_a_number, infinity);
  Bench bench;
  bench.warm_up();
  bench.device.state.status = DeviceStatus::fault;
  double now = virtual_time;
  for (int i = 0; i < 10; ++i) bench.servo.step(now += step);
  check_fall(bench.device.forces);
  CHECK(bench.servo.statistics().stalled_clock == 10);
  bench.device.state = {};
  for (int i = 0; i < 250; ++i) bench.servo.step(now += step);
  CHECK(bench.device.last() == wanted);
}

TEST_CASE("the watchdog's own clock may stall, run backwards or return NaN", "[servo]") {
  Bench bench;
  bench.warm_up();
  for (const double now :
       {virtual_time, virtual_time - 100.0, not_a_number, -infinity, infinity, virtual_time - 200.0}) {
    bench.servo.supervise(now);
  }
  CHECK(bench.servo.statistics().watchdog_takeovers == 0);
  double now = virtual_time - 200.0;
  for (int i = 0; i < 16; ++i) bench.servo.supervise(now += 1e-3);
  CHECK(bench.device.last() == 0.0);
}

TEST_CASE("a tick within a tick does nothing", "[servo]") {
  Bench bench;
  bench.warm_up();
  bench.law = [&](const DeviceState&) {
    bench.servo.step(virtual_time);
    return Eigen::Vector3d(wanted, 0.0, 0.0);
  };
  const long reads = bench.device.reads;
  bench.ticks(10);
  CHECK(bench.device.reads == reads + 10);
  CHECK(bench.device.forces.size() == 10);
  CHECK(bench.servo.statistics().idle_ticks == 10);
}

TEST_CASE("a loop that ends normally does not report a fault that has cleared", "[servo]") {
  Bench bench;
  bench.warm_up();
  bench.wait(20);
  CHECK(bench.servo.status().fault == DeviceFault::late_clock);
  bench.warm_up();
  bench.servo.release();
  bench.ticks(20);
  bench.wait(20);
  CHECK(bench.servo.status().fault == DeviceFault::none);
  CHECK(bench.servo.status().phase == ServoPhase::zero);
  CHECK(bench.servo.statistics().watchdog_takeovers == 1);
}

TEST_CASE("a released servo ramps the force down, stops calling the force law and stays at zero until it is reset",
          "[servo]") {
  Bench bench;
  bench.warm_up();
  bench.servo.release();
  int calls = 0;
  const auto good = bench.law;
  bench.law = [&](const DeviceState& state) {
    ++calls;
    return good(state);
  };
  bench.ticks(300);
  check_fall(bench.device.forces);
  CHECK(bench.device.last() == 0.0);
  CHECK(calls == 0);
  bench.wait(100);  // a stopped clock is not a fault then
  CHECK(bench.servo.statistics().watchdog_takeovers == 0);
  CHECK(bench.servo.status().fault == DeviceFault::none);
  bench.servo.reset();
  check_return(bench);
}

TEST_CASE("a released servo whose clock stops still ramps the force down to zero", "[servo]") {
  Bench bench;
  bench.warm_up();
  bench.servo.release();
  bench.wait(16);
  check_fall(bench.device.forces);
}

TEST_CASE("a reset leaves the force at zero", "[servo]") {
  Bench bench;
  bench.warm_up();
  bench.servo.reset();
  CHECK(bench.device.last() == 0.0);
  CHECK(bench.servo.status().phase == ServoPhase::zero);
}

TEST_CASE("the time between two runs is not counted as a period", "[servo]") {
  Bench bench;
  bench.ticks(10);
  bench.servo.reset();
  virtual_time += 100.0;
  bench.ticks(10);
  CHECK(bench.servo.statistics().missed_deadlines == 0);
  CHECK(bench.servo.statistics().period.worst == Approx(period));
  CHECK(bench.servo.statistics().watchdog_takeovers == 0);
}

TEST_CASE("before the first tick the watchdog does nothing", "[servo]") {
  Bench bench;
  bench.wait(1000);
  CHECK(bench.device.forces.empty());
  CHECK(bench.servo.statistics().watchdog_takeovers == 0);
}

TEST_CASE("periods, work and missed deadlines are those of the clocks", "[servo]") {
  Bench bench;
  bench.law = [](const DeviceState&) {
    virtual_time += 0.25e-3;
    return Eigen::Vector3d(wanted, 0.0, 0.0);
  };
  double now = 0.0;
  for (int i = 0; i < 1000; ++i) bench.servo.step(now += period);
  bench.servo.step(now += 2.0 * period);
  CHECK(bench.servo.statistics().missed_deadlines == 1);
  bench.servo.step(now += 3.0 * period);
  const ServoStatistics statistics = bench.servo.statistics();
  CHECK(statistics.ticks == 1002);
  CHECK(statistics.missed_deadlines == 3);
  CHECK(statistics.period.count == 1001);
  CHECK(statistics.period.p50 == Approx(1e-3).epsilon(detail::DurationHistogram::relative_error));
  CHECK(statistics.period.p99 == Approx(1e-3).epsilon(detail::DurationHistogram::relative_error));
  CHECK(statistics.period.worst == Approx(3e-3));
  CHECK(statistics.work.count == 1002);
  CHECK(statistics.work.p50 == Approx(0.25e-3).epsilon(detail::DurationHistogram::relative_error));
}

TEST_CASE("every fault has a unique name", "[servo]") {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < device_fault_count; ++i) {
    const std::string name = to_string(static_cast<DeviceFault>(i));
    CHECK(name != "unknown");
    CHECK(std::count(names.begin(), names.end(), name) == 0);
    names.push_back(name);
  }
  CHECK(to_string(static_cast<DeviceFault>(device_fault_count)) == std::string("unknown"));
}

TEST_CASE("servo options out of range are rejected with name and value", "[servo]") {
  const auto message = [](auto&& change) {
    ServoOptions options;
    change(options);
    return error_of(options);
  };
  for (const double bad : {-1.0, 0.5, 2e5, not_a_number}) {
    CHECK(message([&](ServoOptions& o) { o.rate = bad; }).find("rate = ") != std::string::npos);
  }
  CHECK(message([](ServoOptions& o) { o.timeout = 1e-3; }) ==
        "servo loop: timeout = 0.001 s, must be from two periods at 1000 Hz to 1");
  CHECK(message([](ServoOptions& o) { o.timeout = infinity; }).find("timeout") != std::string::npos);
  for (const double bad : {-1e-3, 0.2, not_a_number}) {
    CHECK(message([&](ServoOptions& o) { o.ramp_down = bad; }).find("ramp_down = ") != std::string::npos);
  }
  for (const double bad : {-1e-3, 11.0, not_a_number}) {
    CHECK(message([&](ServoOptions& o) { o.ramp_up = bad; }).find("ramp_up = ") != std::string::npos);
  }
  CHECK(message([](ServoOptions&) {}).empty());
  WatchedDevice device;
  CHECK_THROWS_AS(Servo(device, {}), ValueError);
}

TEST_CASE("a servo ticks at the rate asked for or at the device's, and refuses a force law made for another",
          "[servo]") {
  Capabilities profile;
  profile.apparent_mass = 0.05;
  profile.peak_force = 1.0;
  profile.update_rate = 500.0;
  SimulatedDevice device(profile);
  ForceLaw law = [](const DeviceState&) { return Eigen::Vector3d(Eigen::Vector3d::Zero()); };
  CHECK(Servo(device, law).rate() == 500.0);
  ServoOptions asked;
  asked.rate = 2000.0;
  CHECK(Servo(device, law, asked).rate() == 2000.0);
  law.rate = 800.0;
  CHECK_THROWS_WITH(Servo(device, law),
                    "servo loop: rate = 500 Hz, the device's, but the force law is made for 800 Hz");
  CHECK_THROWS_WITH(Servo(device, law, asked), "servo loop: rate = 2000 Hz, but the force law is made for 800 Hz");
}

TEST_CASE("a force law is any function that returns a vector, and its copies ask the same one", "[servo]") {
  struct Spring {
    Eigen::Vector3d operator()(const DeviceState& sample) { return stiffness * sample.position; }
    double stiffness = 3.0;
  };
  Eigen::Vector3d (*const pointer)(const DeviceState&) = [](const DeviceState& sample) -> Eigen::Vector3d {
    return 3.0 * sample.position;
  };
  const Eigen::Vector3d lasting(0.0, 3.0, 6.0);
  const std::vector<ForceLaw> laws = {
      Spring(), pointer, std::function<Eigen::Vector3d(const DeviceState&)>(pointer),
      [](const DeviceState& sample) noexcept -> Eigen::Vector3d { return 3.0 * sample.position; },
      [&lasting](const DeviceState&) -> const Eigen::Vector3d& { return lasting; }};
  DeviceState sample;
  sample.position = {0.0, 1.0, 2.0};
  for (ForceLaw law : laws) {
    law.rate = 500.0;
    ForceLaw copy = law;
    CHECK(copy(sample) == lasting);
    const ForceLaw moved = std::move(copy);
    CHECK(moved(sample) == lasting);
    CHECK(moved.rate == 500.0);
  }
  CHECK_FALSE(ForceLaw());
  CHECK_FALSE(ForceLaw(std::function<Eigen::Vector3d(const DeviceState&)>()));
}

TEST_CASE("with ramp times of zero the force changes immediately", "[servo]") {
  ServoOptions options;
  options.ramp_down = options.ramp_up = 0.0;
  Bench bench(options);
  bench.tick();
  CHECK(bench.device.last() == wanted);
  bench.device.state.status = DeviceStatus::fault;
  bench.tick();
  CHECK(bench.device.last() == 0.0);
  bench.device.state = {};
  bench.tick();
  CHECK(bench.device.last() == wanted);
}

TEST_CASE("a servo does not allocate, whatever fault occurs", "[servo]") {
  Bench bench;
  bench.warm_up();
  const auto hang = [&](const DeviceState&) {
    bench.wait(30);
    return Eigen::Vector3d(not_a_number, 0.0, 0.0);
  };
  const auto good = bench.law;
  std::function<Eigen::Vector3d(const DeviceState&)> bad = hang;
  const std::size_t before = calligraphy_test::allocations();
  for (int i = 0; i < 20; ++i) {
    bench.ticks(10);
    std::swap(bench.law, bad);
    bench.tick();
    std::swap(bench.law, bad);
    bench.ticks(210);
    bench.device.state.status = static_cast<DeviceStatus>(i % 6);
    bench.ticks(10);
    bench.device.state.status = DeviceStatus::ok;
    const ServoStatistics statistics = bench.servo.statistics();
    static_cast<void>(statistics);
  }
  const std::size_t after = calligraphy_test::allocations();
  CHECK(after == before);
}

TEST_CASE("whatever fault occurs, the force stays finite, never steps up and is zero in time", "[servo]") {
  const unsigned seed = GENERATE(range(1u, 9u));
  Bench bench;
  Random random(seed);
  const auto chance = [&](double share) { return random.next() < share; };
  int bad_law = 0;  // ticks left
  bench.law = [&](const DeviceState& state) -> Eigen::Vector3d {
    CHECK(state.position.allFinite());
    if (bad_law > 0) {
      switch (random.index(4)) {
        case 0:
          throw std::runtime_error("bad");
        case 1:
          return Eigen::Vector3d::Constant(not_a_number);
        case 2:
          bench.wait(static_cast<int>(random.index(40)));
          break;
        default:
          break;
      }
    }
    return {wanted, 0.0, 0.0};
  };
  std::vector<double> written;  // when [s]
  bench.device.while_writing = [&] { written.push_back(virtual_time); };
  int bad_device = 0;
  double unusable_since = infinity;
  for (int tick = 0; tick < 20'000; ++tick) {
    if (chance(0.004)) bad_device = 1 + static_cast<int>(random.index(40));
    if (chance(0.002)) bad_law = 1 + static_cast<int>(random.index(20));
    bench.device.state = {};
    if (bad_device-- > 0) {
      bench.device.state.status = static_cast<DeviceStatus>(random.index(6));
      if (chance(0.1)) bench.device.state.position.x() = not_a_number;
    }
    if (chance(0.002)) bench.wait(static_cast<int>(random.index(40)));
    bench.tick();
    --bad_law;
    const DeviceStatus status = bench.device.state.status;
    const bool unusable = status == DeviceStatus::disconnected || status == DeviceStatus::fault ||
                          status == DeviceStatus::needs_calibration;
    unusable_since = unusable ? std::min(unusable_since, virtual_time) : infinity;
    if (virtual_time - unusable_since > 0.0165) REQUIRE(bench.device.last() == 0.0);
  }
  REQUIRE(written.size() == bench.device.forces.size());
  double last = 0.0;
  for (std::size_t i = 0; i < written.size(); ++i) {
    const Eigen::Vector3d& force = bench.device.forces[i];
    REQUIRE(force.allFinite());
    REQUIRE(force.x() >= 0.0);
    REQUIRE(force.x() <= wanted);
    // Up by at most one tick of the ramp-up, down by at most a ramp-down since the write before last.
    REQUIRE(force.x() - last <= wanted * 1.001 / 200.0);
    const double since = written[i] - (i < 2 ? 0.0 : written[i - 2]) + period;
    REQUIRE(last - force.x() <= wanted * since / ServoOptions().ramp_down * (1.0 + 1e-9));
    last = force.x();
  }
  CHECK_FALSE(bench.device.touched_by_two);
}

TEST_CASE("at any point of a tick the device has exactly one owner", "[servo]") {
  const unsigned seed = GENERATE(range(1u, 5u));
  Bench bench;
  Random random(seed);
  bool looking = false;
  const auto look_in = [&] {
    if (looking) return;  // called for the watchdog's own writes, too
    looking = true;
    const int milliseconds = random.index(4) == 0 ? static_cast<int>(random.index(30)) : 0;
    bench.wait(milliseconds);
    looking = false;
  };
  bench.device.while_reading = look_in;
  bench.device.while_writing = look_in;
  bench.law = [&](const DeviceState&) {
    look_in();
    return Eigen::Vector3d(wanted, 0.0, 0.0);
  };
  for (int tick = 0; tick < 5'000; ++tick) {
    bench.servo.step(virtual_time += period);
    look_in();
  }
  CHECK_FALSE(bench.device.touched_by_two);
  CHECK(bench.servo.statistics().watchdog_takeovers > 0);
  CHECK(bench.servo.statistics().fault_count(DeviceFault::timed_out) > 0);
  CHECK(std::all_of(bench.device.forces.begin(), bench.device.forces.end(),
                    [](const Eigen::Vector3d& force) { return force.x() >= 0.0 && force.x() <= wanted; }));
  bench.device.while_reading = bench.device.while_writing = nullptr;
  bench.law = [](const DeviceState&) { return Eigen::Vector3d(wanted, 0.0, 0.0); };
  bench.wait(30);  // the force has ramped down
  bench.ticks(30);
  check_return(bench);
}

TEST_CASE("servo and watchdog in two real threads never touch the device at the same time", "[servo]") {
  WatchedDevice device;
  std::atomic<long> calls = 0;
  ServoOptions options;
  options.ramp_up = 1e-3;
  Servo servo(
      device,
      [&](const DeviceState&) {
        // Occasionally slow enough to lose the device.
        if (++calls % 50 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(8));
        return Eigen::Vector3d(wanted, 0.0, 0.0);
      },
      options);
  const auto now = [] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  };
  std::atomic<bool> done = false;
  std::thread watchdog([&] {
    while (!done) servo.supervise(now());
  });
  for (int i = 0; i < 1000; ++i) servo.step(now());
  done = true;
  watchdog.join();
  CHECK_FALSE(device.touched_by_two);
  const ServoStatistics statistics = servo.statistics();
  CHECK(statistics.ticks + statistics.idle_ticks == 1000);
  CHECK(std::all_of(device.forces.begin(), device.forces.end(),
                    [](const Eigen::Vector3d& force) { return force.x() >= 0.0 && force.x() <= wanted; }));
}

TEST_CASE("two servos with two devices are independent", "[servo]") {
  Bench first;
  Bench second;
  second.law = [](const DeviceState&) -> Eigen::Vector3d { throw std::runtime_error("bad"); };
  for (int i = 0; i < 300; ++i) {
    first.tick();
    second.servo.step(virtual_time);
  }
  CHECK(first.device.last() == wanted);
  CHECK(second.device.last() == 0.0);
  CHECK(first.servo.status().fault == DeviceFault::none);
  CHECK(second.servo.status().fault == DeviceFault::bad_force);
}

TEST_CASE("a simulated pen rests on a wall with the servo as it does without", "[servo]") {
  SimulatedDevice device(device_profile("desktop"), {0.15, 5.0, 500.0}, {0.0, 0.0, 0.01});
  device.set_intention({{0.0, 0.0, -0.005}, Eigen::Vector3d::Zero()});
  Servo servo(
      device,
      [](const DeviceState& state) {
        const double penetration = -state.position.z();
        return Eigen::Vector3d(0.0, 0.0, penetration > 0.0 ? 800.0 * penetration - 2.0 * state.velocity.z() : 0.0);
      },
      calligraphy_test::untimed());
  for (int tick = 0; tick < 2000; ++tick) {
    servo.step(device.time());
    device.advance(period);
  }
  CHECK(-device.true_position().z() == Approx(0.005 * 500.0 / 1300.0).margin(2e-4));
}

namespace {

/// A backend whose device does not measure velocity, and whose author has filled in nothing else either.
class NoVelocity final : public HapticDevice {
 public:
  explicit NoVelocity(SimulatedDevice& physics) : physics_(physics) {}

  const Capabilities& capabilities() const noexcept override { return physics_.capabilities(); }
  DeviceState read() noexcept override {
    DeviceState state;
    state.position = physics_.read().position;
    return state;
  }
  void write(const Eigen::Vector3d& force) noexcept override { physics_.write(force); }
  void close() noexcept override { physics_.close(); }

 private:
  SimulatedDevice& physics_;
};

}  // namespace

TEST_CASE("a damped wall does not vanish on a device that does not measure velocity", "[servo]") {
  SimulatedDevice physics(device_profile("desktop"), {0.15, 5.0, 500.0}, {0.0, 0.0, 0.01});
  physics.set_intention({{0.0, 0.0, -0.005}, Eigen::Vector3d::Zero()});
  NoVelocity device(physics);
  REQUIRE(device.read().velocity.array().isNaN().all());
  // As examples/02_own_force_law.cpp has it: std::max(0.0, NaN) is 0.
  Servo servo(
      device,
      [](const DeviceState& state) -> Eigen::Vector3d {
        const double penetration = -state.position.z();
        if (penetration <= 0.0) return {0.0, 0.0, 0.0};
        return {0.0, 0.0, std::max(0.0, 800.0 * penetration - 2.0 * state.velocity.z())};
      },
      calligraphy_test::untimed());
  for (int tick = 0; tick < 2000; ++tick) {
    servo.step(physics.time());
    physics.advance(period);
  }
  CHECK(-physics.true_position().z() == Approx(0.005 * 500.0 / 1300.0).margin(2e-4));
  CHECK(physics.applied_force().z() == Approx(800.0 * 0.005 * 500.0 / 1300.0).margin(0.16));
}
