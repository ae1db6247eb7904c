// PhantomDevice and the servo loop on an emulated Phantom, through libusb or hidapi: in virtual time, which stands
// still until each report has passed through the bus and each command has been accepted.
#include <atomic>
#include <cerrno>
#include <chrono>
#include <functional>
#include <thread>

#include <calligraphy/devices/phantom/phantom_device.hpp>
#include <calligraphy/devices/servo.hpp>

#include "../../../still_clock.hpp"
#include "catch.hpp"
#include "emulated_phantom.hpp"
#include "plugged_touch.hpp"

using namespace calligraphy;
using namespace calligraphy_test;

namespace {

PhantomOptions options_of_touch() {
  PhantomOptions options;
  options.wire_profile = "simulated";
  options.keep_calibration = true;  // the emulated encoders keep counting
  return options;
}

/// The force during the faults.
Eigen::Vector3d spring(const DeviceState& state) {
  return 150.0 * (Eigen::Vector3d(0.02, 0.02, 0.015) - state.position);
}

struct Stack {
  explicit Stack(const UsbIdentity& identity)
      : phantom(bed, identity, {0.1, 3.0, 300.0}),
        device((phantom.bus.plug_in(1, "2"), phantom::make_link("", patient)), options_of_touch(),
               [this] { return now.load(); }),
        servo(
            device, [this](const DeviceState& state) { return leaning ? spring(state) : Eigen::Vector3d(0, 0, 0); },
            untimed()) {
    REQUIRE(phantom.bus.wait(listens));
    run(50);
    phantom.arm.docked = false;
    const Eigen::Vector3d from = phantom.arm.tip.true_position(), to(0.01, 0.02, 0.01);
    phantom.arm.tip.set_intention({from, 4.0 * (to - from)});
    run(250);
    phantom.arm.move_hand(to);
    run(100);
    leaning = true;
    run(200);
  }

  FreshBed bed;
  std::atomic<double> now{100.0};
  bool leaning = false;
  EmulatedPhantom phantom;
  PhantomDevice device;
  Servo servo;
  double max_step = 0.0;  ///< maximum force change per millisecond [N]
  Eigen::Vector3d last_force = Eigen::Vector3d::Zero();
  std::uint64_t expected_reports = 0;

  /// Waits at most ten seconds of real time.
  static bool reached(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::microseconds(20));
    }
    return true;
  }

  bool told(DeviceFault fault) const { return device.statistics().faults[static_cast<std::size_t>(fault)] > 0; }

  /// One millisecond: physics, report, servo, command. Does not wait while the bus has a fault.
  void turn(bool reports = true, bool commands = true) {
    now = now + 1e-3;
    const std::uint64_t before = phantom.pushed;
    const std::uint64_t reports_before = device.statistics().reports;
    phantom.step();
    if (reports && phantom.pushed > before) {
      REQUIRE(reached([&] { return device.statistics().reports > reports_before; }));
    }
    const std::uint64_t taken = phantom.bus.packets_taken();
    const std::uint64_t sent = device.statistics().commands;
    servo.step(now);
    if (commands && device.statistics().commands > sent) {
      REQUIRE(reached([&] { return phantom.bus.packets_taken() > taken; }));
    }
    const Eigen::Vector3d force = phantom.motor_force();
    max_step = std::max(max_step, (force - last_force).norm());
    last_force = force;
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) turn();
  }
};

void require_zero_within_20_ms(Stack& stack, bool reports, bool commands) {
  for (int i = 0; i < 20; ++i) stack.turn(reports, commands);
  REQUIRE(stack.last_force.norm() == 0.0);
}

void require_return_without_a_jump(Stack& stack) {
  stack.run(400);
  REQUIRE(stack.servo.status().fault == DeviceFault::none);
  CHECK(stack.last_force.norm() > 0.7);
  CHECK(stack.max_step < 0.15);
}

UsbIdentity touch_of_the_stack() {
  return CALLIGRAPHY_TEST_HIDRAW && GENERATE(true, false) ? serial_touch() : hid_touch();
}

}  // namespace

TEST_CASE("through the whole stack the tip is where the hand holds it, and the force is the one requested", "[stack]") {
  Stack stack(touch_of_the_stack());
  CHECK(stack.servo.status().fault == DeviceFault::none);
  // 0.055 mm a count and the friction of the joints' rounding.
  const DeviceState state = stack.device.read();
  CHECK((state.position - stack.phantom.arm.tip.true_position()).norm() < 2e-4);
  CHECK((stack.last_force - spring(state)).norm() < 0.03);
  CHECK(stack.device.statistics().lost_reports == 0);
  stack.device.close();
  CHECK_FALSE(stack.phantom.arm.last_command().motors_on);
}

TEST_CASE("an unplugged device loses its force, and resumes elsewhere without a force step", "[stack]") {
  Stack stack(touch_of_the_stack());
  stack.max_step = 0.0;
  stack.phantom.unplug(GENERATE(UnplugOrder::error_first, UnplugOrder::gone_first));
  REQUIRE(Stack::reached([&] { return stack.told(DeviceFault::unplugged); }));
  require_zero_within_20_ms(stack, false, false);
  CHECK(stack.servo.status().fault == DeviceFault::unplugged);
  CHECK(stack.servo.status().device == DeviceStatus::disconnected);
  for (int i = 0; i < 200; ++i) stack.turn(false, false);
  stack.phantom.bus.plug_in(2, "1.4");
  REQUIRE(Stack::reached([&] { return stack.device.statistics().opened == 2; }));
  REQUIRE(stack.phantom.bus.wait(listens));
  stack.max_step = 0.0;  // the motors of an unplugged device are off immediately
  require_return_without_a_jump(stack);
}

TEST_CASE("a device that resets itself without leaving the bus is restarted, and its force returns", "[stack]") {
  Stack stack(touch_of_the_stack());
  CHECK(stack.phantom.times_started() == 1);
  stack.phantom.reset_itself();
  if (stack.phantom.bus.identity().link == LinkKind::usb) {
    stack.phantom.bus.fail_next(GENERATE(EPIPE, EPROTO));
  } else {
    stack.phantom.bus.set_taking(Taking::never);  // hidapi-libusb clears no halt
    stack.turn(true, false);
    REQUIRE(Stack::reached([&] { return stack.told(DeviceFault::link_error); }));
    stack.phantom.bus.set_taking(Taking::at_once);
  }
  REQUIRE(Stack::reached([&] {
    stack.turn(false, false);
    return stack.phantom.times_started() == 2;
  }));
  REQUIRE(stack.phantom.bus.wait(listens));
  stack.run(30);  // the motors have the old force until a packet arrives
  stack.max_step = 0.0;
  require_return_without_a_jump(stack);
  CHECK(stack.phantom.times_started() == 2);
}

TEST_CASE("a device that resets itself and is silent until started is restarted", "[stack]") {
  FreshBed bed;
  EmulatedPhantom phantom(bed, touch_of_the_stack(), {0.1, 3.0, 300.0});
  phantom.silent_until_started = true;
  phantom.bus.plug_in(1, "2");
  PhantomDevice device(phantom::make_link("", {0.02, 60.0, 0.005}), options_of_touch());
  const auto reports_come = [&] {
    const std::uint64_t before = device.statistics().reports;
    return Stack::reached([&] {
      phantom.step();
      return device.statistics().reports > before;
    });
  };
  REQUIRE(reports_come());
  phantom.bus.set_taking(Taking::never);  // packets sent while it restarts are lost
  phantom.reset_itself();
  REQUIRE(
      Stack::reached([&] { return device.statistics().faults[static_cast<std::size_t>(DeviceFault::timed_out)] > 0; }));
  phantom.bus.set_taking(Taking::at_once);
  phantom.reset_itself();
  CHECK(reports_come());
}

TEST_CASE("short, empty, overlong, corrupted or missing frames bring the force to zero within 20 ms", "[stack]") {
  struct Case {
    const char* name;
    DeviceFault fault;
    std::function<bool(Bytes&)> tamper;
    bool reports = true;
  };
  const UsbIdentity identity = touch_of_the_stack();
  std::vector<Case> cases{{"short", DeviceFault::short_frame,
                           [](Bytes& frame) {
                             frame.resize(20);
                             return true;
                           }},
                          {"spoilt", DeviceFault::corrupted_frame,
                           [](Bytes& frame) {
                             frame[8] ^= std::byte{0x10};
                             return true;
                           }},
                          {"missing", DeviceFault::silent, [](Bytes&) { return false; }, false}};
  if (identity.link == LinkKind::usb) {  // hidapi returns neither empty nor overlong reports
    cases.push_back({"empty", DeviceFault::empty_frame, [](Bytes& frame) {
                       frame.clear();
                       return true;
                     }});
    cases.push_back({"overlong", DeviceFault::overlong_frame, [](Bytes& frame) {
                       frame.resize(60);
                       return true;
                     }});
  }
  Stack stack(identity);
  for (const Case& failure : cases) {
    CAPTURE(failure.name);
    stack.max_step = 0.0;
    stack.phantom.arm.tamper = failure.tamper;
    require_zero_within_20_ms(stack, failure.reports, true);
    CHECK(stack.servo.status().fault == failure.fault);
    for (int i = 0; i < 50; ++i) stack.turn(failure.reports, true);
    CHECK(stack.last_force.norm() == 0.0);
    stack.phantom.arm.tamper = nullptr;
    require_return_without_a_jump(stack);
  }
}

TEST_CASE("a device that answers 15 ms late loses its force and recovers it", "[stack]") {
  Stack stack(touch_of_the_stack());
  stack.max_step = 0.0;
  int tick = 0;
  stack.phantom.arm.tamper = [&tick](Bytes&) { return ++tick % 15 == 0; };
  require_zero_within_20_ms(stack, true, true);
  CHECK(stack.servo.status().fault != DeviceFault::none);
  stack.phantom.arm.tamper = nullptr;
  require_return_without_a_jump(stack);
}

#if CALLIGRAPHY_TEST_HIDRAW
TEST_CASE("a failing endpoint is named, and the force ramps down and returns", "[stack]") {
  struct Case {
    int error;
    DeviceFault fault;
  };
  Stack stack(serial_touch());
  for (const Case failure : {Case{EPIPE, DeviceFault::stalled}, Case{EPROTO, DeviceFault::link_error},
                             Case{EOVERFLOW, DeviceFault::overlong_frame}}) {
    CAPTURE(failure.error);
    stack.max_step = 0.0;
    stack.phantom.bus.fail_next(failure.error);
    REQUIRE(Stack::reached([&] { return stack.told(failure.fault); }));
    REQUIRE(stack.phantom.bus.wait(listens));
    // The endpoint works again immediately; the fault is still reported, and the force reaches zero.
    bool named = false, zero = false;
    for (int i = 0; i < 20; ++i) {
      stack.turn();
      named = named || stack.servo.status().fault == failure.fault;
      zero = zero || stack.last_force.norm() == 0.0;
    }
    CHECK(named);
    CHECK(zero);
    require_return_without_a_jump(stack);
  }
}

TEST_CASE("a device that refuses commands is reported as stalled, and recovers", "[stack]") {
  Stack stack(serial_touch());
  stack.phantom.bus.set_taking(Taking::stalls);
  stack.turn(true, false);
  REQUIRE(Stack::reached([&] { return stack.told(DeviceFault::stalled); }));
  // No command reaches it: its own watchdog removes the force, 20 ms after the last one.
  for (int i = 0; i < 22; ++i) stack.turn(true, false);
  CHECK(stack.last_force.norm() == 0.0);
  CHECK(stack.servo.status().fault == DeviceFault::stalled);
  stack.phantom.bus.set_taking(Taking::at_once);
  const std::uint64_t taken = stack.phantom.bus.packets_taken();
  REQUIRE(Stack::reached([&] {
    stack.turn(true, false);
    return stack.phantom.bus.packets_taken() > taken + 2;
  }));
  stack.max_step = 0.0;
  require_return_without_a_jump(stack);
}
#endif
