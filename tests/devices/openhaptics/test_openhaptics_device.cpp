#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/devices/emergency_stop.hpp>
#include <calligraphy/devices/openhaptics/openhaptics_device.hpp>
#include <calligraphy/devices/servo_loop.hpp>
#include <calligraphy/devices/simulated_device.hpp>

#include "../../allocation_counter.hpp"
#include "../../catch.hpp"
#include "stand_in.hpp"

using namespace calligraphy;
using calligraphy_test::StandIn;
using calligraphy_test::StandInControl;

namespace {

const StandIn* clock_of_stand_in = nullptr;
double virtual_time() noexcept { return (*clock_of_stand_in)->time(); }

/// A runtime with one plugged device, in virtual time.
struct Lab {
  Lab() {
    clock_of_stand_in = &runtime;
    runtime->plug_in("Default Device", "PHANTOM Omni", "omni");
  }
  OpenHapticsOptions options(const std::string& device = {}) const {
    OpenHapticsOptions result;
    result.library = STAND_IN_LIBHD;
    result.device = device;
    result.time = virtual_time;
    return result;
  }
  Eigen::Vector3d force(int device = 0) const {
    Eigen::Vector3d result;
    runtime->applied_force(device, result.data());
    return result;
  }
  Eigen::Vector3d position(int device = 0) const {
    Eigen::Vector3d result;
    runtime->true_position(device, result.data());
    return result;
  }
  void intend(const Eigen::Vector3d& position, int device = 0) const {
    const Eigen::Vector3d still = Eigen::Vector3d::Zero();
    runtime->set_intention(device, position.data(), still.data());
  }
  void steps(int count) const {
    for (int i = 0; i < count; ++i) runtime->step();
  }

  StandIn runtime{STAND_IN_LIBHD};
};

/// A servo clocked by the device's own clock.
struct Driven {
  explicit Driven(
      OpenHapticsDevice& driven, ForceLaw law = [](const DeviceState&) { return Eigen::Vector3d(1.0, 0.0, 0.0); })
      : device(driven), servo(driven, std::move(law), virtual_options()) {
    device.clock()->start([this](double now) { servo.step(now); });
  }
  ~Driven() { device.clock()->stop(); }

  static ServoOptions virtual_options() {
    ServoOptions options;
    options.work_clock = virtual_time;
    return options;
  }

  OpenHapticsDevice& device;
  Servo servo;
};

template <class Action>
std::string message_of(Action&& action) {
  try {
    action();
  } catch (const DeviceError& error) {
    return error.what();
  }
  return {};
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

bool comes(const std::function<bool()>& condition) {
  for (int i = 0; i < 10'000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace

TEST_CASE("a pen rests on a wall through the vendor's runtime, in metres and newtons", "[openhaptics]") {
  Lab lab;
  OpenHapticsDevice device(lab.options());
  lab.intend({0.0, 0.0, -0.005});
  DeviceState last;
  Driven loop(device, [&](const DeviceState& state) {
    last = state;
    const double penetration = -state.position.z();
    return Eigen::Vector3d(0.0, 0.0, penetration > 0.0 ? 300.0 * penetration : 0.0);
  });
  lab.steps(3000);
  // Hand and wall as two springs, and the omni's friction of 0.26 N.
  CHECK(lab.position().z() == Approx(-0.005 * 300.0 / 600.0).margin(0.26 / 600.0 + 1e-4));
  CHECK(last.position.z() == Approx(lab.position().z()).margin(55e-6));
  CHECK(last.velocity.allFinite());
  CHECK(last.time == Approx(3.0).margin(0.01));
  CHECK(lab.force().z() == Approx(300.0 * -last.position.z()).margin(0.02));
  CHECK(loop.servo.statistics().ticks == 3000);
  CHECK(loop.servo.status().phase == ServoPhase::running);
  CHECK(lab.runtime->broken_rules() == 0);
}

TEST_CASE("velocity is in metres per second, the buttons are the runtime's four, and the pen leans as its transform says",
          "[openhaptics]") {
  Lab lab;
  OpenHapticsDevice device(lab.options());
  const double position[3] = {0.0, 0.0, 0.0};
  const double velocity[3] = {0.1, 0.0, 0.0};
  lab.runtime->set_intention(0, position, velocity);
  lab.runtime->set_buttons(0, 0x15);
  DeviceState last;
  Driven loop(device, [&](const DeviceState& state) {
    last = state;
    return Eigen::Vector3d::Zero().eval();
  });
  lab.steps(500);
  CHECK(last.velocity.x() == Approx(0.1).epsilon(0.01));
  CHECK(last.buttons == 0x5);
  constexpr double degree = 0.017453292519943295;
  CHECK(last.stylus.altitude == Approx(60.0 * degree));
  CHECK(last.stylus.azimuth == Approx(-90.0 * degree));
}

TEST_CASE("capabilities come from the runtime where it provides them, otherwise from the closest profile",
          "[openhaptics]") {
  StandIn runtime(STAND_IN_LIBHD);
  clock_of_stand_in = &runtime;
  struct Row {
    const char* model;
    const char* profile;
  };
  const Row row = GENERATE(Row{"PHANTOM Omni", "omni"}, Row{"Touch", "touch"}, Row{"Touch X", "desktop"},
                           Row{"PHANTOM Desktop", "desktop"}, Row{"PHANTOM Premium 1.5", "premium-1.5"});
  CAPTURE(row.model);
  runtime->plug_in("Default Device", row.model, row.profile);
  OpenHapticsOptions options;
  options.library = STAND_IN_LIBHD;
  OpenHapticsDevice device(options);
  const Capabilities& expected = device_profile(row.profile);
  CHECK(device.capabilities().model == row.model);
  CHECK(device.capabilities().workspace.isApprox(expected.workspace));
  CHECK(device.capabilities().peak_force == expected.peak_force);
  CHECK(device.capabilities().continuous_force == expected.continuous_force);
  CHECK(device.capabilities().usable_stiffness == expected.usable_stiffness);
  CHECK(device.capabilities().update_rate == 1000.0);
  CHECK(device.serial() == "540-12345");
  CHECK(device.library() == STAND_IN_LIBHD);
}

TEST_CASE("each error of the runtime is reported as status and fault, and the force returns after it",
          "[openhaptics]") {
  struct Row {
    unsigned code;
    DeviceStatus status;
    DeviceFault fault;
    const char* name;
  };
  const Row row =
      GENERATE(Row{0x0201, DeviceStatus::fault, DeviceFault::runtime_error, "maximum force exceeded"},
               Row{0x0202, DeviceStatus::fault, DeviceFault::runtime_error, "force impulse limit exceeded"},
               Row{0x0203, DeviceStatus::fault, DeviceFault::runtime_error, "velocity limit exceeded"},
               Row{0x0204, DeviceStatus::fault, DeviceFault::runtime_error, "force error"},
               Row{0x0300, DeviceStatus::fault, DeviceFault::device_error, "device fault"},
               Row{0x0302, DeviceStatus::disconnected, DeviceFault::link_error, "communication error"},
               Row{0x0303, DeviceStatus::disconnected, DeviceFault::link_error, "communication configuration error"},
               Row{0x0304, DeviceStatus::fault, DeviceFault::timed_out, "timer error"},
               Row{0x0402, DeviceStatus::fault, DeviceFault::runtime_error, "frame error"},
               Row{0x7777, DeviceStatus::fault, DeviceFault::runtime_error, "error 0x7777"});
  CAPTURE(row.name);
  Lab lab;
  OpenHapticsDevice device(lab.options());
  Driven loop(device);
  lab.steps(300);
  CHECK(lab.force().x() == Approx(1.0));
  const int times = GENERATE(1, 40);
  lab.runtime->inject(0, row.code, times);
  double before = 1.0;
  for (int i = 0; i < 20; ++i) {
    lab.steps(1);
    if (i == 0) {
      CHECK(loop.servo.status().device == row.status);
      CHECK(loop.servo.status().fault == row.fault);
    }
    if (i < 10) CHECK(before - lab.force().x() == Approx(0.1));
    before = lab.force().x();
    if (i == 9) CHECK(before == 0.0);
  }
  CHECK(loop.servo.statistics().fault_count(row.fault) == 1);
  CHECK(device.last_error() == row.code);
  CHECK(openhaptics_error_name(row.code) == row.name);
  before = lab.force().x();
  for (int i = 0; i < 300; ++i) {
    lab.steps(1);
    CHECK(lab.force().x() - before <= 0.00501);
    before = lab.force().x();
  }
  CHECK(lab.force().x() == Approx(1.0));
  CHECK(loop.servo.status().fault == DeviceFault::none);
  CHECK(lab.runtime->broken_rules() == 0);
}

TEST_CASE("warm motors are reported while the force is lowered, to none if need be, and the law is told the lower one",
          "[openhaptics]") {
  Lab lab;
  const bool tells_temperature = GENERATE(false, true);
  lab.runtime->set_motor_temperature(0, tells_temperature ? 0.4 : std::numeric_limits<double>::quiet_NaN());
  OpenHapticsDevice device(lab.options());
  const double peak = device.capabilities().peak_force;
  DeviceState last;
  Driven loop(device, [&](const DeviceState& state) {
    last = state;
    return Eigen::Vector3d(0.6 * peak, 0.0, 0.8 * peak);
  });
  lab.steps(300);
  REQUIRE(lab.force().norm() == Approx(peak));
  const auto run = [&](int ticks, double max_step) {
    for (int i = 0; i < ticks; ++i) {
      const Eigen::Vector3d before = lab.force();
      lab.steps(1);
      REQUIRE(last.force.isApprox(before));
      REQUIRE(std::abs(lab.force().norm() - before.norm()) <= max_step * peak);
      REQUIRE(lab.force().z() * 0.6 == Approx(lab.force().x() * 0.8));
    }
  };
  if (tells_temperature) {
    lab.runtime->set_motor_temperature(0, 0.85);
    run(30'000, 2e-4);
    CHECK(lab.force().norm() == Approx(0.5 * peak));  // halfway from 0.7 to 1
    CHECK(last.status == DeviceStatus::warm_motors);
    lab.runtime->set_motor_temperature(0, 1.0);
    run(200, 2e-2);
  } else {
    lab.runtime->inject(0, 0x0200, 20'000);
    run(1000, 2e-4);
    CHECK(lab.force().norm() < 0.95 * peak);
    CHECK(last.status == DeviceStatus::warm_motors);
    run(18'900, 2e-4);
  }
  CHECK(lab.force().isZero(0.0));
  CHECK(last.status == DeviceStatus::warm_motors);
  lab.runtime->set_motor_temperature(0, 0.6);
  run(15'000, 2e-4);
  CHECK(lab.force().norm() < 0.6 * peak);
  run(16'000, 2e-4);
  CHECK(lab.force().norm() == Approx(peak));
  CHECK((last.status == DeviceStatus::warm_motors) == tells_temperature);  // it would come and go
  CHECK(contains(static_cast<HapticDevice&>(device).advice(), "warm motors") == tells_temperature);
  lab.runtime->set_motor_temperature(0, 0.4);
  run(100, 0.0);
  CHECK(last.status == DeviceStatus::ok);
  CHECK(device.advice().empty());
  CHECK(loop.servo.statistics().faults == ServoStatistics().faults);
  CHECK(lab.runtime->broken_rules() == 0);
}

TEST_CASE("of several errors in one tick the most severe counts, whatever their order", "[openhaptics]") {
  std::vector<unsigned> codes = {0x0200, 0x0302, 0x0204};
  std::rotate(codes.begin(), codes.begin() + GENERATE(0, 1, 2), codes.end());
  Lab lab;
  OpenHapticsDevice device(lab.options());
  Driven loop(device);
  lab.steps(10);
  for (const unsigned code : codes) lab.runtime->report(code);
  lab.steps(1);
  CHECK(loop.servo.status().device == DeviceStatus::disconnected);
  CHECK(device.last_error() == codes.back());
  lab.steps(1);
  CHECK(loop.servo.status().device == DeviceStatus::ok);  // all were taken
}

TEST_CASE("a missing runtime is named, with what to install", "[openhaptics]") {
  OpenHapticsOptions options;
  options.library = "/nowhere/libHD.so";
  const std::string message = message_of([&] { OpenHapticsDevice device(options); });
  CHECK(contains(message, "/nowhere/libHD.so"));
  CHECK(contains(message, "install OpenHaptics"));
  CHECK(contains(message, "CALLIGRAPHY_LIBHD"));
  const OpenHapticsRuntime runtime = openhaptics_runtime("/nowhere/libHD.so");
  CHECK_FALSE(runtime.found);
  CHECK(runtime.advice == message);
}

TEST_CASE("a runtime that was loaded stays, since its own threads may outlive the device", "[openhaptics]") {
  REQUIRE(openhaptics_runtime(STAND_IN_LIBHD).found);
  void* const loaded = dlopen(STAND_IN_LIBHD, RTLD_NOW | RTLD_NOLOAD);
  REQUIRE(loaded != nullptr);
  dlclose(loaded);
}

TEST_CASE("every function that a runtime lacks is named", "[openhaptics]") {
  OpenHapticsOptions options;
  options.library = INCOMPLETE_LIBHD;
  const std::string message = message_of([&] { OpenHapticsDevice device(options); });
  CHECK(contains(message, "lacks hdGetError, hdUnschedule:"));
  CHECK(contains(message, INCOMPLETE_LIBHD));
  CHECK_FALSE(openhaptics_runtime(INCOMPLETE_LIBHD).found);
}

TEST_CASE("without a file name the runtime is located by the environment variable", "[openhaptics]") {
  Lab lab;
  setenv("CALLIGRAPHY_LIBHD", STAND_IN_LIBHD, 1);
  const OpenHapticsRuntime found = openhaptics_runtime();
  setenv("CALLIGRAPHY_LIBHD", "/nowhere/else.so", 1);
  const OpenHapticsRuntime lost = openhaptics_runtime();
  const OpenHapticsRuntime named = openhaptics_runtime(STAND_IN_LIBHD);
  setenv("CALLIGRAPHY_LIBHD", "", 1);
  const OpenHapticsRuntime usual = openhaptics_runtime();
  unsetenv("CALLIGRAPHY_LIBHD");
  CHECK(found.found);
  CHECK(found.library == STAND_IN_LIBHD);
  CHECK_FALSE(lost.found);
  CHECK(contains(lost.advice, "/nowhere/else.so"));
  CHECK(named.found);
  if (!usual.found) CHECK(contains(usual.advice, "libHD.so.3"));
}

TEST_CASE("a missing device is rejected with the runtime's reason and a remedy", "[openhaptics]") {
  Lab lab;
  const std::string message = message_of([&] { OpenHapticsDevice device(lab.options("Left")); });
  CHECK(contains(message, "the device \"Left\""));
  CHECK(contains(message, "HD error 0x0301: no such device"));
  CHECK(contains(message, "plug it in"));
  OpenHapticsDevice device(lab.options());
  CHECK(contains(message_of([&] { OpenHapticsDevice again(lab.options()); }), "its default device"));
}

TEST_CASE("a device requests calibration in the inkwell, gives no force before it, and ramps up after it",
          "[openhaptics]") {
  Lab lab;
  lab.runtime->set_calibration(0, 0x5002);
  OpenHapticsDevice device(lab.options());
  CHECK(device.advice() == "needs calibration: put the pen into the inkwell");
  Driven loop(device);
  lab.steps(300);
  CHECK(loop.servo.status().device == DeviceStatus::needs_calibration);
  CHECK(loop.servo.status().fault == DeviceFault::uncalibrated);
  CHECK(lab.force().isZero(0.0));
  lab.runtime->put_into_inkwell(0, true);
  lab.steps(51);
  CHECK(loop.servo.status().device == DeviceStatus::ok);
  CHECK(device.advice().empty());
  CHECK(lab.force().x() < 0.3);
  lab.steps(250);
  CHECK(lab.force().x() == Approx(1.0));
  lab.runtime->put_into_inkwell(0, false);
  lab.runtime->set_calibration(0, 0x5002);  // lost while it runs
  lab.steps(70);
  CHECK(lab.force().isZero(0.0));
  CHECK(loop.servo.status().fault == DeviceFault::uncalibrated);
  CHECK(lab.runtime->broken_rules() == 0);
}

TEST_CASE("a device is calibrated by the selected style only", "[openhaptics]") {
  const CalibrationStyle style = GENERATE(CalibrationStyle::automatic, CalibrationStyle::encoder_reset);
  Lab lab;
  lab.runtime->set_calibration(0, 0x5001);
  OpenHapticsOptions options = lab.options();
  options.calibration = style;
  OpenHapticsDevice device(options);
  CHECK(contains(device.advice(), "needs calibration"));
  CHECK_FALSE(contains(device.advice(), "inkwell"));
  Driven loop(device);
  lab.steps(1);
  CHECK(loop.servo.status().device == DeviceStatus::ok);
  CHECK(device.advice().empty());
}

TEST_CASE("the force output is on only while a loop runs, and everything is released in order", "[openhaptics]") {
  Lab lab;
  {
    OpenHapticsDevice device(lab.options());
    CHECK(lab.runtime->is_open(0));
    CHECK_FALSE(lab.runtime->output_enabled(0));
    CHECK_FALSE(lab.runtime->scheduler_runs());
    {
      Driven loop(device);
      CHECK(device.clock()->running());
      CHECK_THROWS_AS(device.clock()->start([](double) {}), ValueError);
      lab.steps(300);
      CHECK(lab.runtime->output_enabled(0));
      CHECK(lab.runtime->scheduler_runs());
      CHECK(lab.runtime->callbacks() == 1);
    }
    CHECK_FALSE(lab.runtime->output_enabled(0));
    CHECK_FALSE(lab.runtime->scheduler_runs());
    CHECK(lab.runtime->callbacks() == 0);
    CHECK(lab.force().isZero(0.0));
    CHECK(lab.runtime->is_open(0));
    Driven again(device);
    lab.steps(300);
    CHECK(lab.force().x() == Approx(1.0));
  }
  CHECK_FALSE(lab.runtime->is_open(0));
  CHECK(lab.runtime->broken_rules() == 0);
}

TEST_CASE("a closed device reports it, accepts no force and can be reopened", "[openhaptics]") {
  Lab lab;
  OpenHapticsDevice device(lab.options());
  {
    Driven loop(device);
    lab.steps(300);
    device.close();
    CHECK_FALSE(lab.runtime->scheduler_runs());
    CHECK_FALSE(lab.runtime->output_enabled(0));
  }
  CHECK(device.read().status == DeviceStatus::disconnected);
  device.write({1.0, 0.0, 0.0});
  device.close();
  OpenHapticsDevice again(lab.options());
  Driven loop(again);
  lab.steps(300);
  CHECK(lab.force().x() == Approx(1.0));
  CHECK(lab.runtime->broken_rules() == 0);
}

TEST_CASE("outside a tick read() returns the last sample as stale, and a force is ignored", "[openhaptics]") {
  Lab lab;
  OpenHapticsDevice device(lab.options());
  lab.intend({0.02, 0.0, 0.0});
  CHECK(device.read().status == DeviceStatus::stale);
  device.write({1.0, 0.0, 0.0});
  CHECK_FALSE(lab.runtime->output_enabled(0));
  {
    Driven loop(device, [](const DeviceState&) { return Eigen::Vector3d::Zero().eval(); });
    lab.steps(1000);
  }
  const DeviceState last = device.read();
  CHECK(last.status == DeviceStatus::stale);
  CHECK(last.position.x() == Approx(0.02).margin(1.1e-3));
  CHECK(lab.runtime->broken_rules() == 0);
}

TEST_CASE("a watchdog in another thread switches the output off, and the next tick with a force switches it on again",
          "[openhaptics]") {
  Lab lab;
  OpenHapticsDevice device(lab.options());
  Driven loop(device);
  lab.steps(300);
  double now = lab.runtime->time();
  std::thread watchdog([&] {  // no tick comes for 20 ms
    for (int i = 0; i < 20; ++i) loop.servo.supervise(now += 1e-3);
  });
  watchdog.join();
  CHECK_FALSE(lab.runtime->output_enabled(0));
  CHECK(lab.force().isZero(0.0));
  CHECK(loop.servo.status().fault == DeviceFault::late_clock);
  lab.steps(10);
  CHECK(lab.runtime->output_enabled(0));
  CHECK(lab.force().x() > 0.0);
  CHECK(lab.force().x() <= 0.0501);
  lab.steps(300);
  CHECK(lab.force().x() == Approx(1.0));
  CHECK(lab.runtime->broken_rules() == 0);
}

TEST_CASE("after an emergency stop the scheduler's next tick writes zero, and the handler calls nothing of the runtime",
          "[openhaptics]") {
  Lab lab;
  OpenHapticsDevice device(lab.options());
  Driven loop(device);
  lab.steps(300);
  REQUIRE(lab.force().x() == Approx(1.0));
  emergency_stop();
  CHECK(lab.force().x() == Approx(1.0));
  lab.steps(1);
  CHECK(lab.force().isZero(0.0));
  lab.steps(300);
  CHECK(lab.force().isZero(0.0));
  clear_emergency_stop();
  lab.steps(300);
  CHECK(lab.force().x() == Approx(1.0));
  CHECK(lab.runtime->broken_rules() == 0);
  REQUIRE(device.warnings().size() == 1);
  CHECK(device.warnings().front().find("SIGKILL") != std::string::npos);
}

TEST_CASE("a force law that hangs within the vendor's frame still loses its force", "[openhaptics]") {
  Lab lab;
  OpenHapticsDevice device(lab.options());
  Servo* servo = nullptr;
  bool hangs = false;
  Driven loop(device, [&](const DeviceState&) {
    if (hangs) {
      double now = virtual_time();
      std::thread watchdog([&] {
        for (int i = 0; i < 30; ++i) servo->supervise(now += 1e-3);
      });
      watchdog.join();
      CHECK_FALSE(lab.runtime->output_enabled(0));
      CHECK(lab.force().isZero(0.0));
    }
    return Eigen::Vector3d(1.0, 0.0, 0.0);
  });
  servo = &loop.servo;
  lab.steps(300);
  hangs = true;
  lab.steps(1);
  hangs = false;
  CHECK(loop.servo.status().fault == DeviceFault::slow_force_law);
  CHECK(lab.force().isZero(0.0));
  lab.steps(300);
  CHECK(lab.force().x() == Approx(1.0));
  CHECK(lab.runtime->broken_rules() == 0);
}

TEST_CASE("a force above the peak is limited, and one that is not finite counts as zero", "[openhaptics]") {
  Lab lab;
  OpenHapticsDevice device(lab.options());
  Eigen::Vector3d wanted(30.0, 40.0, 0.0);
  device.clock()->start([&](double) {
    device.read();
    device.write(wanted);
  });
  const auto commanded = [&] {  // the force passed to the runtime, before its own limit
    Eigen::Vector3d result;
    lab.runtime->commanded_force(0, result.data());
    return result;
  };
  lab.steps(2);
  CHECK(commanded().isApprox(Eigen::Vector3d(0.6, 0.8, 0.0) * 3.3));
  wanted.y() = std::numeric_limits<double>::quiet_NaN();
  lab.steps(1);
  CHECK(commanded().isZero(0.0));
  wanted = {1.0, 2.0, -1.0};
  lab.steps(1);
  CHECK(commanded() == wanted);
  device.clock()->stop();
}

TEST_CASE("two devices share the scheduler, which stops with the last loop", "[openhaptics]") {
  Lab lab;
  lab.runtime->plug_in("Left", "Touch", "touch");
  OpenHapticsDevice right(lab.options());
  OpenHapticsDevice left(lab.options("Left"));
  {
    Driven first(right);
    {
      Driven second(left, [](const DeviceState&) { return Eigen::Vector3d(0.0, -0.5, 0.0); });
      lab.steps(300);
      CHECK(lab.force(0).isApprox(Eigen::Vector3d(1.0, 0.0, 0.0)));
      CHECK(lab.force(1).isApprox(Eigen::Vector3d(0.0, -0.5, 0.0)));
      CHECK(lab.runtime->callbacks() == 2);
      lab.runtime->inject(1, 0x0302, 1);
      lab.steps(1);
      CHECK(first.servo.status().fault == DeviceFault::none);
      CHECK(second.servo.status().fault == DeviceFault::link_error);
      const std::string message = message_of([&] { OpenHapticsDevice third(lab.options("Third")); });
      CHECK(contains(message, "open all devices before the first loop starts"));
    }
    CHECK(lab.runtime->scheduler_runs());
    lab.steps(300);
    CHECK(lab.force(0).x() == Approx(1.0));
    CHECK(lab.force(1).isZero(0.0));
  }
  CHECK_FALSE(lab.runtime->scheduler_runs());
  CHECK(lab.runtime->broken_rules() == 0);
}

TEST_CASE("a scheduler that does not start is an error, and a later start may succeed", "[openhaptics]") {
  Lab lab;
  OpenHapticsDevice device(lab.options());
  const auto [code, text] =
      GENERATE(table<unsigned, std::string>({{0x0102, "0x0102"}, {0x0300, "0x0300"}, {0x0302, "0x0302"},
                                             {0x0304, "0x0304"}, {0x0501, "0x0501"}, {0x0600, "0x0600"},
                                             {0x7777, "0x7777"}}));
  lab.runtime->leave("hdStartScheduler", 0x0103);  // not the reason
  lab.runtime->fail("hdStartScheduler", code);
  const std::string message = message_of([&] { device.clock()->start([](double) {}); });
  CHECK(contains(message, "does not start: HD error " + text + ": an error"));
  CHECK_FALSE(device.clock()->running());
  CHECK(lab.runtime->callbacks() == 0);
  Driven loop(device);
  lab.steps(300);
  CHECK(lab.force().x() == Approx(1.0));
}

TEST_CASE("a scheduler that starts may leave a warning or another call's error behind", "[openhaptics]") {
  Lab lab;
  OpenHapticsDevice device(lab.options());
  lab.runtime->leave("hdStartScheduler", GENERATE(0x0100, 0x0103, 0x0200, 0x0402));
  Driven loop(device);
  lab.steps(300);
  CHECK(lab.force().x() == Approx(1.0));
  CHECK(loop.servo.statistics().faults == ServoStatistics().faults);
}

TEST_CASE("a tick through the runtime does not allocate", "[openhaptics]") {
  Lab lab;
  OpenHapticsDevice device(lab.options());
  std::size_t taken = 0;
  device.clock()->start([&](double) {
    const std::size_t before = calligraphy_test::allocations();
    const DeviceState state = device.read();
    device.write(-10.0 * state.position);
    taken += calligraphy_test::allocations() - before;
  });
  lab.steps(200);
  device.clock()->stop();
  CHECK(taken == 0);
}

TEST_CASE("a servo loop runs on the vendor's own thread and leaves no force behind", "[openhaptics]") {
  Lab lab;
  lab.runtime->run_in_real_time(true);
  OpenHapticsOptions options = lab.options();
  options.time = nullptr;
  OpenHapticsDevice device(options);
  ServoLoopOptions patient;
  patient.servo.timeout = 1.0;  // for a machine under load
  patient.servo.ramp_up = 0.0;
  patient.thread.priority = 0;
  patient.thread.lock_memory = false;
  ServoLoop loop(
      device, [](const DeviceState&) { return Eigen::Vector3d(1.0, 0.0, 0.0); }, patient);
  loop.start();
  CHECK(comes([&] { return loop.statistics().ticks > 20 && lab.force().x() > 0.9; }));
  loop.stop();
  CHECK(lab.force().isZero(0.0));
  CHECK_FALSE(lab.runtime->scheduler_runs());
  CHECK_FALSE(lab.runtime->output_enabled(0));
  loop.start();
  CHECK(comes([&] { return lab.force().x() > 0.9; }));
  loop.stop();
  CHECK(lab.runtime->broken_rules() == 0);
}

TEST_CASE("stopping a clock on the vendor's own thread leaves the output off", "[openhaptics]") {
  Lab lab;
  lab.runtime->run_in_real_time(true);
  OpenHapticsDevice device(lab.options());
  device.clock()->start([&](double) {
    device.read();
    device.write({1.0, 0.0, 0.0});
  });
  CHECK(comes([&] { return lab.force().x() > 0.9; }));
  device.clock()->stop();
  CHECK_FALSE(lab.runtime->output_enabled(0));
  CHECK(lab.force().isZero(0.0));
  CHECK(lab.runtime->callbacks() == 0);
  CHECK(lab.runtime->broken_rules() == 0);
}
