// A complete character through the vendor's runtime: the simulated writer holds the pen of the stub.
#include <algorithm>
#include <cmath>
#include <vector>

#include <calligraphy/devices/openhaptics/openhaptics_device.hpp>
#include <calligraphy/devices/servo.hpp>
#include <calligraphy/devices/servo_clock.hpp>
#include <calligraphy/model/character_list.hpp>
#include <calligraphy/practice/page.hpp>
#include <calligraphy/practice/writer.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

#include "../../../catch.hpp"
#include "../stand_in.hpp"

using namespace calligraphy;
using calligraphy_test::StandIn;

namespace {

const StandIn* stand_in_of_page = nullptr;
double time_of_page() noexcept { return (*stand_in_of_page)->time(); }

}  // namespace

TEST_CASE("a complete character is written through the vendor's runtime despite faults", "[openhaptics]") {
  const bool with_faults = GENERATE(false, true);
  StandIn runtime(STAND_IN_LIBHD);
  stand_in_of_page = &runtime;
  runtime->plug_in("Default Device", "PHANTOM Desktop", "desktop");
  OpenHapticsOptions options;
  options.library = STAND_IN_LIBHD;
  options.time = time_of_page;
  OpenHapticsDevice device(options);

  const PracticePage page = lay_out(std::vector{*built_in_characters().find(U'永')}).front();
  const MotionMapping mapping = upright_page(page.width, page.height);
  HapticRenderer renderer(page.characters, mapping, device.capabilities(),
                          RendererOptions::for_device(device.capabilities()));
  SimulatedWriter writer(page, WriterSkill::skilled(), 1);
  ServoOptions servo_options;
  servo_options.work_clock = time_of_page;
  double largest = 0.0;
  double last = 0.0;
  double max_step = 0.0;
  Servo servo(
      device, [&](const DeviceState& state) { return renderer.update(state).force; }, servo_options);
  device.clock()->start([&](double now) { servo.step(now); });

  constexpr double period = 1e-3;  // [s]
  int finished = 0;
  for (int tick = 0; tick < 120'000 && !writer.done(); ++tick) {
    if (with_faults && tick % 3000 == 2999) runtime->inject(0, tick % 2000 == 999 ? 0x0302 : 0x0204, 15);
    runtime->step();
    const HapticTick& seen = renderer.last();
    const VisualFeedback sight = visual_feedback(seen);
    const Intention intention = writer.update(sight, period);
    const Eigen::Vector3d position = mapping.to_device(intention.position);
    const Eigen::Vector3d velocity = mapping.rotation.transpose() * intention.velocity / mapping.scale;
    runtime->set_intention(0, position.data(), velocity.data());
    Eigen::Vector3d force;
    runtime->applied_force(0, force.data());
    REQUIRE(force.allFinite());
    largest = std::max(largest, force.norm());
    max_step = std::max(max_step, std::abs(force.norm() - last));
    last = force.norm();
    finished = seen.character;
  }
  device.clock()->stop();
  CHECK(writer.done());
  CHECK(finished == 1);
  CHECK(largest > 0.1);
  CHECK(largest <= device.capabilities().peak_force);
  CHECK(max_step <= 0.2 * device.capabilities().peak_force);
  CHECK((servo.statistics().fault_count(DeviceFault::link_error) > 0) == with_faults);
  CHECK(runtime->broken_rules() == 0);
}
