#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/random.hpp>
#include <calligraphy/devices/servo_loop.hpp>

#include "../../allocation_counter.hpp"
#include "../../catch.hpp"
#include "../../sanitized.hpp"
#include "devices/phantom/motor_temperature.hpp"
#include "held_phantom.hpp"

using namespace calligraphy_test;
using calligraphy::Random;
using Catch::Matchers::Contains;

namespace {

template <class Exception>
std::string refusal(const PhantomOptions& options) {
  auto wire = std::make_shared<Wire>();
  try {
    PhantomDevice device(std::make_unique<MemoryLink>(wire), options);
  } catch (const Exception& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("a phantom needs its inkwell before positions are valid, and then they are those of the tip",
          "[phantom][device]") {
  HeldPhantom held;
  held.arm.count_offset = {60000, 7, 40000};  // encoders start at arbitrary counts
  CHECK(held.device.read().status == DeviceStatus::needs_calibration);
  CHECK_THAT(held.device.advice(), Contains("inkwell"));
  const DeviceState first = held.turn();
  CHECK(first.status == DeviceStatus::needs_calibration);
  CHECK(first.fault == DeviceFault::uncalibrated);
  held.bring_up();
  DeviceState state = held.turn();
  CHECK(state.status == DeviceStatus::ok);
  CHECK(state.fault == DeviceFault::none);
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d to(corner & 1 ? 0.07 : -0.07, corner & 2 ? 0.05 : -0.05, corner & 4 ? 0.03 : -0.03);
    held.carry(to, 0.5);
    state = held.turn();
    REQUIRE(state.status == DeviceStatus::ok);
    // Half a count of each joint, at most 0.27 m from the axis.
    REQUIRE((state.position - held.arm.tip.true_position()).norm() < 0.27 * 1.5 * 0.5 / 2425.0);
    REQUIRE((state.position - to).norm() < 2e-3);  // where friction left it
  }
}

TEST_CASE("a phantom reports buttons, docking and the time of its reports", "[phantom][device]") {
  HeldPhantom held;
  held.bring_up();
  held.arm.buttons = 2;
  const DeviceState before = held.turn();
  CHECK(before.buttons == 2);
  CHECK_FALSE(held.device.docked());
  const DeviceState after = held.turn();
  CHECK(after.time - before.time == Approx(1e-3));
  held.arm.docked = true;
  held.turn();
  CHECK(held.device.docked());
}

TEST_CASE("a sample is returned once and then as stale", "[phantom][device]") {
  HeldPhantom held;
  held.bring_up();
  const DeviceState fresh = held.turn();
  const DeviceState again = held.device.read();
  CHECK(fresh.status == DeviceStatus::ok);
  CHECK(again.status == DeviceStatus::stale);
  CHECK(again.position == fresh.position);
  CHECK(again.time == fresh.time);
}

TEST_CASE("of several reports between two reads the newest is returned, and none of their motion is lost",
          "[phantom][device]") {
  HeldPhantom held;
  held.bring_up();
  held.arm.tip.set_intention({held.arm.tip.true_position(), {0.2, 0.0, 0.0}});
  for (int i = 0; i < 10; ++i) {
    for (int j = 0; j < 7; ++j) held.tick();
    REQUIRE((held.device.read().position - held.arm.tip.true_position()).norm() < 1e-4);
  }
}

TEST_CASE("the velocity is that of the tip after the filter", "[phantom][device]") {
  PhantomOptions options = simulated_options();
  options.velocity_cutoff = 20.0;
  HeldPhantom held(options);
  CHECK(held.device.capabilities().velocity == VelocitySource::estimated);
  CHECK(held.device.capabilities().velocity_cutoff == 20.0);
  held.bring_up();
  held.arm.tip.set_intention({held.arm.tip.true_position(), {0.15, -0.1, 0.05}});
  for (int i = 0; i < 250; ++i) held.turn();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int i = 0; i < 50; ++i) {
    const DeviceState state = held.turn();
    mean += state.velocity / 50.0;
    REQUIRE(state.velocity_estimated);
    // One count per millisecond is 0.055 m/s; a 20 Hz filter passes an eighth of it.
    REQUIRE((state.velocity - held.arm.tip.true_velocity()).norm() < 0.03);
  }
  CHECK((mean - held.arm.tip.true_velocity()).norm() < 0.005);
  held.carry({0.0, 0.0, 0.0});
  CHECK(held.turn().velocity.norm() < 0.02);
}

TEST_CASE("a lost report does not show in the velocity", "[phantom][device]") {
  HeldPhantom held;
  held.bring_up({-0.07, 0.0, 0.01});
  held.arm.tip.set_intention({held.arm.tip.true_position(), {0.3, 0.05, 0.05}});
  for (int i = 0; i < 400; ++i) {
    held.arm.tamper = [&](Bytes&) { return i % 110 < 108; };  // two in a row
    const DeviceState state = held.turn();
    if (i > 100) REQUIRE((state.velocity - held.arm.tip.true_velocity()).norm() < 0.05);
  }
  CHECK(held.device.statistics().lost_reports > 4);
}

TEST_CASE("a force acts at the tip to within the resolution of the DACs", "[phantom][device]") {
  for (const std::string model : {"omni", "premium-1.5"}) {
    Random random(21);
    const auto unit = [&] { return random.between(-1.0, 1.0); };
    for (int pose = 0; pose < 12; ++pose) {
      HeldPhantom held(simulated_options(model));
      const Eigen::Vector3d half = held.device.capabilities().workspace / 2.0;
      const Eigen::Vector3d place = Eigen::Vector3d{unit(), unit(), unit()}.cwiseProduct(0.9 * half);
      held.bring_up(place);
      const Eigen::Vector3d force{unit(), unit(), unit()};
      for (int i = 0; i < 400; ++i) held.turn([&](const DeviceState&) { return force; });
      // Half a torque step at each joint maps to the tip by J^-T; the angles are known to half a count.
      const Eigen::Matrix3d to_tip = tip_jacobian(held.arm.arm, held.arm.joints()).transpose().inverse();
      const double step = 0.5 * 4e-4 * to_tip.cwiseAbs().rowwise().sum().maxCoeff() + 2e-3 * force.norm();
      CAPTURE(model, place.transpose(), force.transpose(), held.arm.motor_force().transpose());
      REQUIRE((held.arm.motor_force() - force).cwiseAbs().maxCoeff() < step);
      REQUIRE(step < 0.02);
    }
  }
}

TEST_CASE("a force above the peak or the range of the DACs is limited, with its direction preserved",
          "[phantom][device]") {
  HeldPhantom held;
  held.bring_up();
  Eigen::Vector3d wanted(30.0, -20.0, 10.0);
  for (int i = 0; i < 200; ++i) held.turn([&](const DeviceState&) { return wanted; });
  Eigen::Vector3d given = held.arm.motor_force();
  CHECK(given.norm() == Approx(3.3).epsilon(0.01));
  CHECK(given.normalized().dot(wanted.normalized()) > 0.9999);
  CHECK((held.device.read().force - given).norm() < 0.02);  // rounded to counts

  // DACs that output at most 0.2 N m: less than 3.3 N at any pose.
  HeldPhantom weak("torque-per-count 4e-4 4e-4 -4e-4", "torque-per-count 1e-4 1e-4 -1e-4");
  weak.bring_up();
  for (int i = 0; i < 200; ++i) weak.turn([&](const DeviceState&) { return wanted; });
  given = weak.arm.motor_force();
  CHECK(given.norm() < 1.7);
  CHECK(given.norm() > 0.8);
  CHECK((weak.device.read().force - given).norm() < 0.02);
  CHECK(given.normalized().dot(wanted.normalized()) > 0.9999);
  std::int64_t most = 0;
  for (const std::int64_t torque : weak.arm.last_command().torque) most = std::max(most, std::abs(torque));
  CHECK(most == 2047);
}

TEST_CASE("a force that is NaN or overflows never reaches the motors", "[phantom][device]") {
  HeldPhantom held;
  held.bring_up();
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 200; ++i) held.turn([&](const DeviceState&) { return Eigen::Vector3d(0.5, 0.0, 0.0); });
  for (const Eigen::Vector3d& bad : {Eigen::Vector3d(nan, 0.0, 0.0), Eigen::Vector3d(0.0, infinity, 0.0)}) {
    held.turn([&](const DeviceState&) { return bad; });
    CHECK(held.arm.motor_force().norm() == 0.0);
  }
  held.turn([&](const DeviceState&) { return Eigen::Vector3d(1e308, 1e308, 1e308); });
  CHECK(held.arm.motor_force().norm() == Approx(3.3).epsilon(0.01));
}

TEST_CASE("the motors are off before calibration, in the inkwell and without drive", "[phantom][device]") {
  const auto push = [](const DeviceState&) { return Eigen::Vector3d(1.0, 0.0, 0.0); };
  HeldPhantom held;
  held.arm.docked = false;
  for (int i = 0; i < 300; ++i) {
    REQUIRE(held.turn(push).status == DeviceStatus::needs_calibration);
    REQUIRE_FALSE(held.arm.last_command().motors_on);
  }
  held.arm.docked = true;
  for (int i = 0; i < 300; ++i) {
    held.turn(push);
    REQUIRE_FALSE(held.arm.last_command().motors_on);
  }
  held.arm.docked = false;
  for (int i = 0; i < 300; ++i) held.turn(push);
  CHECK(held.arm.last_command().motors_on);
  CHECK(held.arm.motor_force().x() == Approx(1.0).epsilon(0.02));

  PhantomOptions options = simulated_options();
  options.drive = false;
  HeldPhantom listening(options);
  listening.bring_up();
  for (int i = 0; i < 300; ++i) {
    REQUIRE(listening.turn(push).status == DeviceStatus::ok);
    REQUIRE_FALSE(listening.arm.last_command().motors_on);
  }
}

TEST_CASE("a device may be calibrated by angles instead of the inkwell", "[phantom][device]") {
  HeldPhantom held;
  held.arm.docked = false;
  held.turn();
  held.device.calibrate(held.arm.joints());
  CHECK(held.turn().status == DeviceStatus::ok);
  held.carry({0.01, 0.02, 0.01});
  CHECK((held.turn().position - held.arm.tip.true_position()).norm() < 2e-4);
  CHECK_THROWS_AS(held.device.calibrate({0.0, std::nan(""), 0.0}), ValueError);
}

TEST_CASE("every docking recalibrates", "[phantom][device]") {
  HeldPhantom held;
  const Eigen::Vector3d inkwell = held.arm.tip.true_position();
  held.bring_up();
  for (int i = 0; i < 60; ++i) {  // an encoder that slips, a count at a time
    held.arm.count_offset[0] += 1;
    held.turn();
  }
  CHECK((held.turn().position - held.arm.tip.true_position()).norm() > 3e-3);
  held.arm.tip.set_grip({0.1, 20.0, 20000.0});  // the inkwell guides the pen into its place
  held.carry(inkwell);
  held.arm.docked = true;
  for (int i = 0; i < 30; ++i) held.turn();
  CHECK((held.turn().position - held.arm.tip.true_position()).norm() < 3e-4);
}

TEST_CASE("a wrap of the encoders does not move the tip", "[phantom][device]") {
  HeldPhantom held;
  held.arm.count_offset = {65535, 3, 65500};
  held.bring_up();
  for (int i = 0; i < 6; ++i) {
    held.carry({i % 2 ? 0.07 : -0.07, i % 3 ? 0.05 : -0.05, 0.0}, 0.5);
    REQUIRE(held.turn().status == DeviceStatus::ok);
    REQUIRE((held.device.read().position - held.arm.tip.true_position()).norm() < 2e-4);
  }
  CHECK(held.device.statistics().faults[static_cast<std::size_t>(DeviceFault::leaping_encoder)] == 0);
}

TEST_CASE("a hand that holds still or draws in the plane of the arm raises no alarm", "[phantom][device]") {
  HeldPhantom held;
  held.bring_up({0.0, 0.0, 0.0});  // the waist never turns
  for (int i = 0; i < 20000; ++i) REQUIRE(held.turn().status == DeviceStatus::ok);
  for (const double y : {0.04, -0.03}) {
    held.carry({0.0, y, 0.0});
    REQUIRE(held.turn().status == DeviceStatus::ok);
  }
  // A joint between two counts flickers for minutes.
  held.arm.tamper = [&, odd = false](Bytes& frame) mutable {
    RawSample sample = held.arm.codec.decode_report(frame);
    odd = !odd;
    sample.encoders[1] += odd;
    sample.encoders[2] += odd;
    held.arm.codec.encode_report(sample, frame);
    return true;
  };
  for (int i = 0; i < 60000; ++i) REQUIRE(held.turn().status == DeviceStatus::ok);
}

TEST_CASE("one or two lost reports, or a repeated one, are counted and tolerated", "[phantom][device]") {
  HeldPhantom held;
  held.bring_up();
  held.arm.move_hand({0.03, 0.0, 0.0});
  for (int i = 0; i < 3000; ++i) {
    const int phase = i % 150;
    held.arm.tamper = [&](Bytes&) { return phase != 20 && phase != 70 && phase != 71; };
    const DeviceState state = held.turn();
    REQUIRE((state.status == DeviceStatus::ok || state.status == DeviceStatus::stale));
    REQUIRE(state.fault == DeviceFault::none);
  }
  CHECK(held.device.statistics().lost_reports == 60);
  const Bytes old = held.arm.report();
  held.arm.tamper = [&](Bytes& frame) {
    frame = old;
    return true;
  };
  held.arm.tamper = nullptr;
  held.turn();
  held.arm.wire->listener->received(held.arm.report());
  CHECK(held.device.read().status == DeviceStatus::stale);
  CHECK(held.device.statistics().repeated_reports == 1);
  CHECK(held.turn().status == DeviceStatus::ok);
}

TEST_CASE("the dead-man bit changes with each write and not by itself", "[phantom][device]") {
  HeldPhantom held;
  held.bring_up();
  bool last = held.arm.last_command().toggle;
  for (int i = 0; i < 10; ++i) {
    held.turn();
    REQUIRE(held.arm.last_command().toggle != last);
    last = !last;
  }
  for (int i = 0; i < 100; ++i) held.tick();
  CHECK(held.arm.last_command().toggle == last);
}

TEST_CASE(
    "without writes from the servo loop the link switches the motors off, and the force ramps up again afterwards",
    "[phantom][device]") {
  HeldPhantom held;
  held.bring_up();
  const auto push = [](const DeviceState&) { return Eigen::Vector3d(0.0, 0.8, 0.0); };
  for (int i = 0; i < 300; ++i) held.turn(push);
  REQUIRE(held.arm.motor_force().norm() > 0.7);
  for (int i = 0; i < 22; ++i) held.tick();
  CHECK_FALSE(held.arm.last_command().motors_on);
  for (int i = 0; i < 100; ++i) held.tick();
  CHECK(held.device.statistics().released == 1);
  CHECK(held.device.read().force.isZero(0.0));
  double before = 0.0;
  for (int i = 0; i < 300; ++i) {
    held.turn(push);
    const double now = held.arm.motor_force().norm();
    REQUIRE(now - before < 0.05);
    before = now;
  }
  CHECK(before > 0.7);
}

TEST_CASE("closing switches the motors off and sends the profile's stop commands", "[phantom][device]") {
  HeldPhantom held;
  held.bring_up();
  const WireProfile& profile = held.arm.codec.profile();
  REQUIRE(held.arm.wire->commands == profile.start);
  for (int i = 0; i < 200; ++i) held.turn([](const DeviceState&) { return Eigen::Vector3d(1.0, 0.0, 0.0); });
  REQUIRE(held.arm.last_command().motors_on);
  const Eigen::Vector3d position = held.turn().position;
  held.device.close();
  CHECK_FALSE(held.arm.last_command().motors_on);
  CHECK(held.arm.wire->listener == nullptr);
  REQUIRE(held.arm.wire->commands.size() == profile.start.size() + 1 + profile.stop.size());
  CHECK_FALSE(held.arm.codec.decode_command(held.arm.wire->commands[profile.start.size()]).motors_on);
  CHECK(held.arm.wire->commands.back() == profile.stop.back());
  const std::uint64_t sent = held.arm.wire->sent;
  held.device.write({1.0, 0.0, 0.0});
  CHECK(held.arm.wire->sent == sent);
  CHECK(held.device.read().status == DeviceStatus::disconnected);
  CHECK(held.device.read().position == position);
  held.device.close();  // a second call does nothing
}

TEST_CASE("a destroyed phantom leaves the motors off, even if the link fails", "[phantom][device]") {
  std::shared_ptr<Wire> wire;
  {
    HeldPhantom held;
    wire = held.arm.wire;
    held.bring_up();
    for (int i = 0; i < 200; ++i) held.turn([](const DeviceState&) { return Eigen::Vector3d(1.0, 0.0, 0.0); });
    wire->fails_commands = true;
  }
  CHECK_FALSE(PacketCodec(wire_profile("simulated")).decode_command(wire->newest).motors_on);
}

TEST_CASE("warm motors get less torque, are reported, and never overheat", "[phantom][device]") {
  HeldPhantom held;
  held.bring_up();
  const auto push = [](const DeviceState&) { return Eigen::Vector3d(2.5, 0.0, 0.0); };
  bool was_warm = false;
  double last_force = 0.0;
  for (int i = 0; i < (calligraphy_test::sanitized ? 20'000 : 300'000); ++i) {
    const DeviceState state = held.turn(push);
    was_warm = was_warm || state.status == DeviceStatus::warm_motors;
    REQUIRE(state.fault == DeviceFault::none);
    REQUIRE((state.status == DeviceStatus::ok || state.status == DeviceStatus::warm_motors));
  }
  if (calligraphy_test::sanitized) return;
  last_force = held.arm.motor_force().norm();
  CHECK(was_warm);
  CHECK_THAT(held.device.advice(), Contains("warm motors"));
  CHECK((held.device.read().force - held.arm.motor_force()).norm() < 0.02);  // not the 2.5 N that were asked for
  CHECK(last_force < 2.0);
  CHECK(last_force > 0.6);
  CHECK(held.device.statistics().warmest_motor < 1.0);
  CHECK(held.device.statistics().warmest_motor > 0.8);
}

TEST_CASE("without the thermal limit overheated motors are cut off until they have cooled", "[phantom][device]") {
  PhantomOptions options = simulated_options();
  options.limit_heat = false;
  HeldPhantom held(options);
  held.bring_up();
  const auto push = [](const DeviceState&) { return Eigen::Vector3d(3.0, 0.0, 0.0); };
  int ticks = 0;
  DeviceState state = held.turn(push);
  while (state.fault != DeviceFault::overheated && ticks < 200'000) {
    state = held.turn(push);
    ++ticks;
  }
  REQUIRE(state.status == DeviceStatus::fault);
  for (int i = 0; i < 15; ++i) held.turn(push);
  CHECK_FALSE(held.arm.last_command().motors_on);
  const double at_cut = held.device.statistics().warmest_motor;
  CHECK(at_cut == Approx(1.0).epsilon(0.01));
  while (held.turn(push).status == DeviceStatus::fault && ticks < 2'000'000) ++ticks;
  CHECK(held.device.statistics().warmest_motor == Approx(MotorTemperature::warm).epsilon(0.001));
}

TEST_CASE("gravity is compensated on request", "[phantom][device]") {
  PhantomOptions options = simulated_options();
  options.gravity = true;
  HeldPhantom held(options);
  held.bring_up();
  for (int i = 0; i < 300; ++i) held.turn();
  const RawCommand command = held.arm.last_command();
  const Joints joints = held.arm.joints();
  CHECK(command.motors_on);
  CHECK(command.torque[0] == 0);
  CHECK(static_cast<double>(command.torque[1]) == Approx(0.06 * std::cos(joints[1]) / 4e-4).margin(1.0));
  CHECK(static_cast<double>(command.torque[2]) == Approx(0.04 * std::sin(joints[2]) / -4e-4).margin(1.0));
  HeldPhantom light;
  light.bring_up();
  CHECK(light.arm.last_command().torque == PerJoint<std::int64_t>{});
}

TEST_CASE("two phantoms at once are independent", "[phantom][device]") {
  HeldPhantom left, right(simulated_options("premium-1.5"));
  left.bring_up({-0.05, 0.0, 0.0});
  right.bring_up({0.1, 0.05, 0.0});
  for (int i = 0; i < 300; ++i) {
    const DeviceState a = left.turn([](const DeviceState&) { return Eigen::Vector3d(0.4, 0.0, 0.0); });
    const DeviceState b = right.turn([](const DeviceState&) { return Eigen::Vector3d(0.0, -0.7, 0.0); });
    REQUIRE((a.position - left.arm.tip.true_position()).norm() < 2e-4);
    REQUIRE((b.position - right.arm.tip.true_position()).norm() < 4e-4);
  }
  CHECK((left.arm.motor_force() - Eigen::Vector3d(0.4, 0.0, 0.0)).norm() < 0.02);
  CHECK((right.arm.motor_force() - Eigen::Vector3d(0.0, -0.7, 0.0)).norm() < 0.02);
  left.device.close();
  CHECK(right.turn().status == DeviceStatus::ok);
}

TEST_CASE("a serial stream drives a phantom as packets do, however it is split", "[phantom][device]") {
  HeldPhantom held("framing packet", "framing serial 0x20 0x21");
  REQUIRE(held.arm.wire->commands[0].size() == 4 + 4);  // the first byte of the five is the code
  CHECK(held.arm.wire->commands[0][2] == std::byte{0x53});
  Bytes pending;
  std::mt19937 random(9);
  held.arm.tamper = [&](Bytes& frame) {
    pending.push_back(std::byte{0xA5});  // noise between the frames
    pending.insert(pending.end(), frame.begin(), frame.end());
    while (pending.size() > 20) {
      const std::size_t part = std::min<std::size_t>(pending.size(), 1 + random() % 64);
      held.arm.wire->listener->received(std::span(pending).first(part));
      pending.erase(pending.begin(), pending.begin() + static_cast<std::ptrdiff_t>(part));
    }
    return false;
  };
  held.bring_up();
  for (int i = 0; i < 300; ++i) {
    const DeviceState state = held.turn([](const DeviceState&) { return Eigen::Vector3d(0.0, 0.0, 0.9); });
    REQUIRE(state.fault == DeviceFault::none);
    REQUIRE((state.position - held.arm.tip.true_position()).norm() < 1e-3);
  }
  CHECK((held.arm.motor_force() - Eigen::Vector3d(0.0, 0.0, 0.9)).norm() < 0.02);
  CHECK(held.device.statistics().skipped_bytes > 1000);
}

TEST_CASE("reading, writing and reports, good or bad, do not allocate", "[phantom][device]") {
  HeldPhantom held;
  held.bring_up();
  std::vector<Bytes> reports;
  for (int i = 0; i < 50; ++i) {
    held.arm.advance();
    reports.push_back(held.arm.report());
  }
  reports[20][5] ^= std::byte{1};
  reports[30].clear();
  std::size_t before = 0;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    if (i == 1) before = allocations();
    held.now += 1e-3;
    held.arm.wire->listener->received(reports[i]);
    held.device.write(held.device.read().position * 10.0);
    if (i == 40) held.arm.wire->listener->changed(DeviceFault::stalled);
  }
  CHECK(allocations() == before);
}

TEST_CASE("a phantom that cannot be driven is rejected, and the message says what is missing", "[phantom][device]") {
  PhantomOptions options;
  CHECK_THAT(refusal<ValueError>(options), Contains("no wire profile") && Contains("docs/wire-profile.md"));
  options.wire_profile = "omni";
  CHECK_THAT(refusal<ValueError>(options), Contains("\"omni\" gives no force") && Contains("counts-per-radian") &&
                                               Contains("docked-angles") && Contains("torque-per-count"));
  options.drive = false;
  CHECK_THAT(refusal<ValueError>(options), Contains("gives no position") && !Contains("torque-per-count"));
  options = simulated_options();
  options.wire_profile = "/nowhere/lab.txt";
  CHECK_THAT(refusal<FileError>(options), Contains("/nowhere/lab.txt"));
  CHECK_THAT(refusal<ValueError>(simulated_options("falcon")), Contains("falcon"));
  CHECK_THAT(refusal<ValueError>(simulated_options("desktop")), Contains("desktop"));
  options = simulated_options();
  options.velocity_cutoff = 0.0;
  CHECK_THAT(refusal<ValueError>(options), Contains("velocity_cutoff = 0 Hz"));
  for (const int priority : {-1, 100}) {
    options = simulated_options();
    options.priority = priority;
    CHECK_THAT(refusal<ValueError>(options), Contains("priority = " + std::to_string(priority)));
  }
  CHECK_THROWS_AS(PhantomDevice(nullptr, simulated_options()), ValueError);
  auto wire = std::make_shared<Wire>();
  wire->refusal = "2988:0302: permission denied";
  CHECK_THROWS_WITH(PhantomDevice(std::make_unique<MemoryLink>(wire), simulated_options()),
                    Contains("permission denied"));
}

TEST_CASE("a device that refuses its start commands reports it and gets no force", "[phantom][device]") {
  auto wire = std::make_shared<Wire>();
  wire->fails_commands = true;
  double now = 0.0;
  PhantomDevice device(std::make_unique<MemoryLink>(wire), simulated_options(), [&] { return now; });
  now = 1.0;
  const DeviceState state = device.read();
  CHECK(state.status == DeviceStatus::fault);
  CHECK(state.fault == DeviceFault::link_error);
}

TEST_CASE("a privilege refused to a phantom's threads is reported once by the servo loop", "[phantom][device]") {
  auto wire = std::make_shared<Wire>();
  wire->warnings = {"no priority: ask for one"};
  PhantomDevice device(std::make_unique<MemoryLink>(wire), simulated_options());
  CHECK(device.warnings() == wire->warnings);
  ServoLoopOptions options;
  options.thread.priority = 0;
  options.thread.lock_memory = false;
  const auto none = [](const DeviceState&) { return Eigen::Vector3d(Eigen::Vector3d::Zero()); };
  CHECK(ServoLoop(device, none, options).start() == wire->warnings);
  options.thread.core = 1023;  // no such core, neither for the loop nor for the link
  ServoLoop pinned(device, none, options);
  const std::vector<std::string> of_core = pinned.start();
  REQUIRE(of_core.size() == 2);
  pinned.stop();
  wire->warnings.push_back(of_core.front());
  PhantomDevice pinned_too(std::make_unique<MemoryLink>(wire), simulated_options());
  CHECK(ServoLoop(pinned_too, none, options).start() == of_core);
}

TEST_CASE("a wire profile without a dead-man bit or an enable bit is warned of, by the loop too", "[phantom][device]") {
  const auto warnings = [](const std::string& line) {
    HeldPhantom held(line, "");
    ServoLoopOptions options;
    options.thread.priority = 0;
    options.thread.lock_memory = false;
    ServoLoop loop(
        held.device, [](const DeviceState&) { return Eigen::Vector3d(Eigen::Vector3d::Zero()); }, options);
    CHECK(loop.start() == held.device.warnings());
    return held.device.warnings();
  };
  CHECK(HeldPhantom().device.warnings().empty());
  const std::vector<std::string> of_toggle = warnings("toggle u16 at 6 bit 4");
  REQUIRE(of_toggle.size() == 1);
  CHECK_THAT(of_toggle.front(), Contains("\"toggle\"") && Contains("SIGKILL"));
  const std::vector<std::string> of_enable = warnings("motors-on u16 at 6 bit 3");
  REQUIRE(of_enable.size() == 1);
  CHECK_THAT(of_enable.front(), Contains("\"motors-on\""));
  PhantomOptions idle = simulated_options();
  idle.drive = false;
  CHECK(HeldPhantom("toggle u16 at 6 bit 4", "", idle).device.warnings().empty());
}

TEST_CASE("an emergency stop switches a phantom's motors off, and they stay off until it is cleared",
          "[phantom][device]") {
  const struct Permitted {
    ~Permitted() { clear_emergency_stop(); }
  } at_the_end;
  HeldPhantom held;
  held.bring_up();
  const auto push = [](const DeviceState&) { return Eigen::Vector3d(1.0, 0.0, 0.0); };
  for (int i = 0; i < 200; ++i) held.turn(push);
  REQUIRE(held.arm.commanded_force().norm() > 0.9);
  emergency_stop();
  CHECK_FALSE(held.arm.last_command().motors_on);
  CHECK(held.arm.commanded_force().norm() == 0.0);
  for (int i = 0; i < 200; ++i) {
    held.turn(push);
    REQUIRE(held.arm.commanded_force().norm() == 0.0);
  }
  clear_emergency_stop();
  for (int i = 0; i < 200; ++i) held.turn(push);
  CHECK(held.arm.commanded_force().norm() > 0.9);
  held.device.close();
  held.arm.wire->newest.clear();
  emergency_stop();  // a closed device is not touched
  CHECK(held.arm.wire->newest.empty());
}

TEST_CASE("a device that comes back while it is being closed is not started again", "[phantom][device]") {
  HeldPhantom held;
  held.bring_up();
  held.arm.wire->at_the_end = [](LinkListener& listener) {
    listener.changed(DeviceFault::unplugged);
    listener.changed(DeviceFault::none);
    listener.changed(DeviceFault::timed_out);
  };
  held.device.close();
  CHECK(held.arm.wire->commands.back() == held.arm.codec.profile().stop.back());
}

TEST_CASE("start commands are sent whenever the link was down, and while the device is silent", "[phantom][device]") {
  HeldPhantom held;
  Wire& wire = *held.arm.wire;
  const auto starts = [&] {
    return std::count(wire.commands.begin(), wire.commands.end(), held.arm.codec.profile().start.front());
  };
  CHECK(starts() == 1);
  int expected = 1;
  for (const DeviceFault fault : {DeviceFault::unplugged, DeviceFault::link_error, DeviceFault::stalled}) {
    wire.listener->changed(fault);
    CHECK(starts() == expected);
    wire.listener->changed(DeviceFault::none);
    CHECK(starts() == ++expected);
  }
  wire.listener->changed(DeviceFault::overlong_frame);  // the device sends: its link was not down
  wire.listener->changed(DeviceFault::none);
  CHECK(starts() == expected);
  for (int i = 0; i < 3; ++i) {
    wire.listener->changed(DeviceFault::timed_out);
    CHECK(starts() == ++expected);
  }
  wire.listener->changed(DeviceFault::none);
  CHECK(starts() == ++expected);
  // Refused start commands are sent again at the next opportunity.
  wire.listener->changed(DeviceFault::stalled);
  wire.fails_commands = true;
  wire.listener->changed(DeviceFault::none);
  wire.fails_commands = false;
  CHECK(held.turn().fault == DeviceFault::link_error);
  wire.listener->changed(DeviceFault::overlong_frame);
  wire.listener->changed(DeviceFault::none);
  CHECK(starts() == ++expected);
}
