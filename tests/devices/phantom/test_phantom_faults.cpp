#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <calligraphy/devices/servo.hpp>

#include "../../catch.hpp"
#include "../../still_clock.hpp"
#include "held_phantom.hpp"

using namespace calligraphy_test;

namespace {

/// The force during the faults: a spring to a point away from the hand.
Eigen::Vector3d spring(const DeviceState& state) {
  return 150.0 * (Eigen::Vector3d(0.02, 0.02, 0.015) - state.position);
}

ServoOptions in_virtual_time() {
  ServoOptions options;
  options.work_clock = calligraphy_test::still_clock;
  return options;
}

/// A phantom with the spring, driven by the library's servo loop or, to test the device on its own, by a force law that
/// ignores every status.
struct Loop {
  explicit Loop(bool with_servo, const PhantomOptions& options = simulated_options())
      : held(options), uses_servo(with_servo), servo(held.device, spring, in_virtual_time()) {
    held.bring_up();
    run(500);
  }

  HeldPhantom held;
  bool uses_servo;
  Servo servo;
  DeviceState state;
  double max_step = 0.0;  ///< maximum force change per millisecond [N]
  Eigen::Vector3d last_force = Eigen::Vector3d::Zero();

  void turn() {
    held.tick();
    if (uses_servo) {
      servo.step(held.now);
    } else {
      state = held.device.read();
      held.device.write(spring(state));
    }
    const Eigen::Vector3d force = held.arm.motor_force();
    max_step = std::max(max_step, (force - last_force).norm());
    last_force = force;
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) turn();
  }

  DeviceFault fault() const { return uses_servo ? servo.status().fault : state.fault; }
};

/// How a fault is injected and cleared.
struct Failure {
  std::string name;
  DeviceFault fault;
  std::function<void(Loop&)> begin;
  std::function<void(Loop&)> end;
  int found_within = 1;  ///< reports until it is detected
};

void spoil(Loop& loop, std::function<bool(Bytes&)> tamper) { loop.held.arm.tamper = std::move(tamper); }
void mend(Loop& loop) { loop.held.arm.tamper = nullptr; }

/// Changes the contents of the report and makes it valid again.
void rewrite(Loop& loop, std::function<void(RawSample&)> change) {
  PacketCodec& codec = loop.held.arm.codec;
  spoil(loop, [&codec, change = std::move(change)](Bytes& frame) {
    RawSample sample = codec.decode_report(frame);
    change(sample);
    codec.encode_report(sample, frame);
    return true;
  });
}

Failure of_link(const std::string& name, DeviceFault fault) {
  return {name, fault,
          [fault](Loop& loop) {
            loop.held.arm.wire->listener->changed(fault);
            spoil(loop, [](Bytes&) { return false; });
          },
          [](Loop& loop) {
            loop.held.arm.wire->listener->changed(DeviceFault::none);
            mend(loop);
          },
          1};
}

Failure of_frames(const std::string& name, DeviceFault fault, std::function<bool(Bytes&)> tamper,
                  int found_within = 1) {
  return {name, fault, [tamper](Loop& loop) { spoil(loop, tamper); }, mend, found_within};
}

std::vector<Failure> failures() {
  std::mt19937 random(17);
  return {
      of_link("stall", DeviceFault::stalled),
      of_link("time-out", DeviceFault::timed_out),
      of_link("link error", DeviceFault::link_error),
      of_frames("empty frames", DeviceFault::empty_frame,
                [](Bytes& frame) {
                  frame.clear();
                  return true;
                }),
      of_frames("short frames", DeviceFault::short_frame,
                [](Bytes& frame) {
                  frame.resize(43);
                  return true;
                }),
      of_frames("overlong frames", DeviceFault::overlong_frame,
                [](Bytes& frame) {
                  frame.push_back(std::byte{0});
                  return true;
                }),
      of_frames("flipped bits", DeviceFault::corrupted_frame,
                [random](Bytes& frame) mutable {
                  frame[random() % frame.size()] ^= std::byte{1} << static_cast<int>(random() % 8);
                  return true;
                }),
      of_frames("frames of zeros", DeviceFault::corrupted_frame,
                [](Bytes& frame) {
                  frame.assign(frame.size(), std::byte{0});
                  return true;
                }),
      of_frames(
          "no frames at all", DeviceFault::silent, [](Bytes&) { return false; }, 9),
      {"a device that answers late", DeviceFault::silent,
       [](Loop& loop) {  // the next report of a device that keeps counting, but 15 ms after the last
         PacketCodec& codec = loop.held.arm.codec;
         spoil(loop, [&codec, ticks = 0u, last = loop.held.arm.sequence](Bytes& frame) mutable {
           if (++ticks % 15 != 0) return false;
           RawSample sample = codec.decode_report(frame);
           sample.sequence = ++last;
           codec.encode_report(sample, frame);
           return true;
         });
       },
       mend, 15},
      {"every third frame lost", DeviceFault::lost_frames,
       [](Loop& loop) { spoil(loop, [n = 0](Bytes&) mutable { return ++n % 3 != 0; }); }, mend, 45},
      {"a sequence that leaps", DeviceFault::lost_frames,
       [](Loop& loop) { rewrite(loop, [n = 0u](RawSample& sample) mutable { sample.sequence += 10 * ++n; }); }, mend,
       1},
      {"a sequence that stands", DeviceFault::repeated_frames,
       [](Loop& loop) { rewrite(loop, [at = loop.held.arm.sequence](RawSample& sample) { sample.sequence = at; }); },
       mend, 3},
      {"a sequence that runs back", DeviceFault::repeated_frames,
       [](Loop& loop) { rewrite(loop, [n = 0u](RawSample& sample) mutable { sample.sequence -= 5 * ++n; }); }, mend, 1},
      {"an encoder that leaps to and fro", DeviceFault::leaping_encoder,
       [](Loop& loop) {
         rewrite(loop, [n = 0](RawSample& sample) mutable {
           if (n++ % 4 != 3) sample.encoders[1] ^= 0x40;
         });
       },
       mend, 1},
      {"warm motors, by the device's own word", DeviceFault::overheated,
       [](Loop& loop) { loop.held.arm.own_fault = DeviceFault::overheated; },
       [](Loop& loop) { loop.held.arm.own_fault = DeviceFault::none; }, 1},
      {"another fault of the device's own", DeviceFault::runtime_error,
       [](Loop& loop) { loop.held.arm.own_fault = DeviceFault::runtime_error; },
       [](Loop& loop) { loop.held.arm.own_fault = DeviceFault::none; }, 1},
      {"a pen outside what the arm can reach", DeviceFault::outside_workspace,
       [](Loop& loop) {
         loop.held.device.calibrate({1.5, 1.0, 1.0});
       },
       [](Loop& loop) { loop.held.device.calibrate(loop.held.arm.joints()); }, 1},
  };
}

}  // namespace

TEST_CASE("every fault brings the force to zero within 20 ms, is reported by name, and clears without a force step",
          "[phantom][faults]") {
  for (const bool with_servo : {true, false}) {
    for (const Failure& failure : failures()) {
      CAPTURE(failure.name, with_servo);
      Loop loop(with_servo);
      REQUIRE(loop.fault() == DeviceFault::none);
      REQUIRE(loop.last_force.norm() > 0.7);
      loop.max_step = 0.0;

      failure.begin(loop);
      int found = 0;
      bool named = false;
      while (!named && found < failure.found_within) {
        loop.turn();
        ++found;
        // The servo loop's timeout for silence is shorter than the device's; both report it by the same name.
        named = loop.fault() == failure.fault;
      }
      REQUIRE(named);
      for (int i = 0; i < 10; ++i) loop.turn();
      REQUIRE(loop.last_force.norm() == 0.0);
      // Faults detected immediately: 11 ms after onset. The others: 20 ms, except for those that need a history.
      if (failure.found_within <= 10) REQUIRE(found + 10 <= 20);
      for (int i = 0; i < 60; ++i) {
        loop.turn();
        REQUIRE(loop.last_force.norm() == 0.0);
        REQUIRE(loop.fault() == failure.fault);
      }
      REQUIRE_FALSE(loop.held.arm.last_command().motors_on);

      failure.end(loop);
      loop.run(600);
      REQUIRE(loop.fault() == DeviceFault::none);
      REQUIRE(loop.last_force.norm() > 0.7);
      // It changes by at most a tenth of the force per millisecond, both in the ramp-down and when it returns.
      CHECK(loop.max_step < 0.15);
      CHECK(loop.held.device.statistics().faults[static_cast<std::size_t>(failure.fault)] > 0);
    }
  }
}

TEST_CASE("a fault in a single report is reported and ramps the force down, too", "[phantom][faults]") {
  for (const bool with_servo : {true, false}) {
    for (const Failure& failure : failures()) {
      if (failure.found_within > 1) continue;
      CAPTURE(failure.name, with_servo);
      Loop loop(with_servo);
      loop.max_step = 0.0;
      failure.begin(loop);
      loop.turn();
      failure.end(loop);
      bool named = loop.fault() == failure.fault, reached_zero = false;
      for (int i = 0; i < 12; ++i) {
        loop.turn();
        named = named || loop.fault() == failure.fault;
        reached_zero = reached_zero || loop.last_force.norm() == 0.0;
      }
      CHECK(named);
      CHECK(reached_zero);
      loop.run(600);
      CHECK(loop.fault() == DeviceFault::none);
      CHECK(loop.last_force.norm() > 0.7);
      CHECK(loop.max_step < 0.15);
    }
  }
}

TEST_CASE("a fault between two reads is reported by the next one", "[phantom][faults]") {
  HeldPhantom held;
  held.bring_up();
  held.arm.wire->listener->changed(DeviceFault::timed_out);
  held.arm.wire->listener->changed(DeviceFault::none);
  for (int i = 0; i < 50; ++i) held.tick();  // a slow reader: 50 ms later there is no fault any more
  const DeviceState state = held.device.read();
  CHECK(state.status == DeviceStatus::fault);
  CHECK(state.fault == DeviceFault::timed_out);
  held.tick();
  CHECK(held.device.read().status == DeviceStatus::ok);
}

TEST_CASE("after an unplug the device is disconnected, and must be docked in the inkwell when it is back",
          "[phantom][faults]") {
  for (const bool with_servo : {true, false}) {
    CAPTURE(with_servo);
    Loop loop(with_servo);
    Wire& wire = *loop.held.arm.wire;
    wire.listener->changed(DeviceFault::unplugged);
    wire.takes_packets = false;
    loop.held.arm.tamper = [](Bytes&) { return false; };
    loop.turn();
    CHECK(loop.fault() == DeviceFault::unplugged);
    CHECK(loop.held.device.read().status == DeviceStatus::disconnected);
    loop.run(3000);
    CHECK(loop.fault() == DeviceFault::unplugged);
    loop.max_step = 0.0;  // the behaviour of a device without a host is not tested here

    // At another port, its encoders at other counts.
    loop.held.arm.count_offset = {111, 2222, 33333};
    loop.held.arm.sequence = 5;
    wire.takes_packets = true;
    const std::size_t commands = wire.commands.size();
    wire.listener->changed(DeviceFault::none);
    CHECK(wire.commands.size() == commands + 1);  // started again
    mend(loop);
    loop.run(500);
    CHECK(loop.held.device.read().status == DeviceStatus::needs_calibration);
    CHECK(loop.last_force.norm() == 0.0);
    CHECK_FALSE(loop.held.arm.last_command().motors_on);

    const Eigen::Vector3d inkwell =
        tip_position(loop.held.arm.arm, *loop.held.arm.codec.profile().docked_angles) - loop.held.arm.arm.centre;
    const auto carry = [&](const Eigen::Vector3d& to) {
      loop.held.arm.tip.set_intention({loop.held.arm.tip.true_position(), to - loop.held.arm.tip.true_position()});
      loop.run(1000);
      loop.held.arm.move_hand(to);
      loop.run(500);
    };
    // Friction leaves the tip slightly off the inkwell; the inkwell itself guides the pen into place.
    loop.held.arm.tip.set_grip({0.1, 20.0, 20000.0});
    carry(inkwell);
    loop.held.arm.docked = true;
    loop.run(50);
    loop.held.arm.docked = false;
    loop.held.arm.tip.set_grip({0.1, 3.0, 300.0});
    carry({0.01, 0.02, 0.01});
    CHECK(loop.fault() == DeviceFault::none);
    CHECK((loop.held.device.read().position - loop.held.arm.tip.true_position()).norm() < 3e-4);
    CHECK(loop.last_force.norm() > 0.7);
    CHECK(loop.max_step < 0.15);
  }
}

TEST_CASE("encoders known to keep counting need no inkwell after an unplug", "[phantom][faults]") {
  PhantomOptions options = simulated_options();
  options.keep_calibration = true;
  Loop loop(true, options);
  loop.max_step = 0.0;
  Wire& wire = *loop.held.arm.wire;
  wire.listener->changed(DeviceFault::unplugged);
  loop.held.arm.tamper = [](Bytes&) { return false; };
  loop.held.arm.tip.set_intention({loop.held.arm.tip.true_position(), {-0.02, 0.01, 0.0}});
  loop.run(1000);  // the arm moves in the meantime
  wire.listener->changed(DeviceFault::none);
  mend(loop);
  loop.held.arm.move_hand(loop.held.arm.tip.true_position());
  loop.run(600);
  CHECK(loop.fault() == DeviceFault::none);
  CHECK((loop.held.device.read().position - loop.held.arm.tip.true_position()).norm() < 2e-4);
  CHECK(loop.last_force.norm() > 0.7);
  CHECK(loop.max_step < 0.15);
}

TEST_CASE("an encoder that is stationary while the others move is reported as stuck", "[phantom][faults]") {
  for (const std::size_t joint : {0u, 1u, 2u}) {
    CAPTURE(joint);
    Loop loop(true);
    // A circle in space of 4 cm, as fast as people write.
    const auto circle = [&](int tick) {
      const double phase = 2.0 * 3.14159265 * tick / 1000.0;
      const Eigen::Vector3d at(0.04 * std::cos(phase) - 0.03, 0.04 * std::sin(phase) + 0.02, 0.02 * std::sin(phase));
      const Eigen::Vector3d velocity =
          2.0 * 3.14159265 * Eigen::Vector3d(-0.04 * std::sin(phase), 0.04 * std::cos(phase), 0.02 * std::cos(phase));
      loop.held.arm.tip.set_intention({at, velocity});
    };
    for (int i = 0; i < 5000; ++i) {
      circle(i);
      loop.turn();
      REQUIRE(loop.fault() == DeviceFault::none);
    }
    const std::int64_t stands = loop.held.arm.codec.decode_report(loop.held.arm.report()).encoders[joint];
    rewrite(loop, [joint, stands](RawSample& sample) { sample.encoders[joint] = stands; });
    int ticks = 0;
    while (loop.fault() == DeviceFault::none && ticks < 10000) {
      circle(ticks++);
      loop.turn();
    }
    CHECK(loop.fault() == DeviceFault::stuck_encoder);
    CHECK(ticks < 8000);
    for (int i = 0; i < 20; ++i) {
      circle(ticks++);
      loop.turn();
    }
    CHECK(loop.last_force.norm() == 0.0);
    CHECK_FALSE(loop.held.arm.last_command().motors_on);
  }
}

TEST_CASE("a persistent jump means that counts were lost and the inkwell is needed", "[phantom][faults]") {
  HeldPhantom held;
  held.bring_up();
  const Eigen::Vector3d before = held.turn().position;
  held.arm.count_offset[2] += 500;
  bool named = false;
  for (int i = 0; i < 30; ++i) {
    const DeviceState state = held.turn();
    named = named || state.fault == DeviceFault::leaping_encoder;
    REQUIRE((state.position - before).norm() < 1e-3);  // the jump itself is never returned as a position
  }
  CHECK(named);
  CHECK(held.turn().status == DeviceStatus::needs_calibration);
}

TEST_CASE("one flipped bit of an encoder has no effect, even where no checksum detects it", "[phantom][faults]") {
  HeldPhantom held;
  held.bring_up();
  held.arm.tip.set_intention({held.arm.tip.true_position(), {0.1, 0.0, 0.0}});
  for (int i = 0; i < 200; ++i) held.turn();
  for (int bit = 6; bit < 16; ++bit) {
    CAPTURE(bit);
    held.arm.tamper = [&](Bytes& frame) {
      RawSample sample = held.arm.codec.decode_report(frame);
      sample.encoders[0] ^= std::int64_t{1} << bit;
      held.arm.codec.encode_report(sample, frame);
      return true;
    };
    const std::uint64_t used = held.device.statistics().used_reports;
    const DeviceState state = held.turn();
    CHECK(state.fault == DeviceFault::leaping_encoder);
    CHECK(held.device.statistics().used_reports == used);
    CHECK((state.position - held.arm.tip.true_position()).norm() < 1e-3);
    held.arm.tamper = nullptr;
    for (int i = 0; i < 30; ++i) held.turn();
    const DeviceState after = held.turn();
    CHECK(after.status == DeviceStatus::ok);
    CHECK((after.position - held.arm.tip.true_position()).norm() < 2e-4);
  }
}

TEST_CASE("refused packets are counted, and nothing blocks", "[phantom][faults]") {
  HeldPhantom held;
  held.bring_up();
  held.arm.wire->takes_packets = false;
  for (int i = 0; i < 10; ++i) held.turn();
  CHECK(held.device.statistics().refused_commands == 10);
  held.arm.wire->takes_packets = true;
  held.turn();
  CHECK(held.device.statistics().refused_commands == 10);
}

TEST_CASE("arbitrary bytes do no harm to a phantom", "[phantom][faults]") {
  for (const bool is_serial : {false, true}) {
    HeldPhantom held(is_serial ? "framing packet" : "rate 1000", is_serial ? "framing serial 0x20 0x21" : "rate 1000");
    held.bring_up();
    std::mt19937 random(31);
    for (int i = 0; i < 20000; ++i) {
      Bytes noise(random() % 80);
      for (std::byte& byte : noise) byte = static_cast<std::byte>(random() % 5 == 0 ? 0xA5 : random());
      held.now += 1e-3;
      held.arm.wire->listener->received(noise);
      held.device.write({1.0, 1.0, 1.0});
      const DeviceState state = held.device.read();
      REQUIRE(state.position.allFinite());
      REQUIRE(state.velocity.allFinite());
      if (i > 40) REQUIRE_FALSE(held.arm.last_command().motors_on);
    }
    held.bring_up();
    CHECK(held.turn().fault != DeviceFault::corrupted_frame);
  }
}
