#include <cmath>
#include <cstring>

#include "ticks.hpp"

using namespace calligraphy;
using namespace calligraphy::c;

calligraphy_status calligraphy_servo_create(calligraphy_device* device, calligraphy_renderer* renderer,
                                            calligraphy_servo** servo) {
  return guarded([&] {
    target(servo, "servo");
    auto law = shared_object<RendererObject>(renderer);
    ServoOptions options;
    options.rate = law->renderer.options().servo_rate;
    options.work_clock = []() noexcept { return 0.0; };  // virtual time stands still during a step
    hand_out(servo, std::make_shared<ServoObject>(shared_object<DeviceObject>(device), std::move(law), options));
  });
}

calligraphy_status calligraphy_servo_step(calligraphy_servo* servo, double now, calligraphy_tick* tick) {
  auto* const found = find<ServoObject>(servo);
  if (!found) return refuse_handle(Kind::servo, servo);
  if (tick) {
    if (const calligraphy_status status = check_size(tick, "calligraphy_tick")) return status;
  }
  if (!std::isfinite(now)) return refuse(CALLIGRAPHY_INVALID_VALUE, "now = %g s, must be finite", now);
  found->servo.step(now);
  if (tick) write_tick(*found->renderer, tick);
  return CALLIGRAPHY_OK;
}

calligraphy_status calligraphy_servo_release(calligraphy_servo* servo) {
  auto* const found = find<ServoObject>(servo);
  if (!found) return refuse_handle(Kind::servo, servo);
  found->servo.release();
  return CALLIGRAPHY_OK;
}

calligraphy_status calligraphy_servo_read_state(const calligraphy_servo* servo, calligraphy_servo_state* state) {
  return guarded([&] {
    const Servo& found = object<ServoObject>(servo).servo;
    const ServoStatus status = found.status();
    const ServoStatistics statistics = found.statistics();
    calligraphy_servo_state result = {};
    result.phase = static_cast<std::int32_t>(status.phase);
    result.device = static_cast<std::int32_t>(status.device);
    result.gain = status.gain;
    result.ticks = statistics.ticks;
    result.missed = statistics.missed_deadlines;
    if (status.fault != DeviceFault::none) std::strncpy(result.fault, to_string(status.fault), sizeof result.fault - 1);
    write_struct(state, "calligraphy_servo_state", result);
  });
}
