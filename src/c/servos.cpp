#include <algorithm>
#include <cmath>
#include <cstring>

#include "ticks.hpp"

namespace calligraphy::c {
namespace {

ServoOptions virtual_time(double rate) {
  ServoOptions options;
  options.rate = rate;
  options.timeout = std::max(options.timeout, 2.0 / rate);  // the minimum of a servo
  options.work_clock = []() noexcept { return 0.0; };       // the program's time stands still during a step
  return options;
}

ForceLaw law_of(ServoObject& servo) {
  HapticRenderer& renderer = servo.renderer->renderer;
  ForceLaw law = [&servo, &renderer](const DeviceState& sample) -> Eigen::Vector3d {
    servo.has_updated = true;
    return renderer.update(sample).force;
  };
  law.rate = renderer.options().servo_rate;
  return law;
}

/// Sets the status and events of a tick in which the renderer was not updated.
void describe_gap(const ServoStatus& status, calligraphy_tick* tick) noexcept {
  switch (status.device) {
    case DeviceStatus::ok:
    case DeviceStatus::warm_motors:
      tick->status =
          status.fault == DeviceFault::corrupted_frame ? CALLIGRAPHY_TICK_BAD_SAMPLE : CALLIGRAPHY_TICK_STALE;
      break;
    case DeviceStatus::stale:
      tick->status = CALLIGRAPHY_TICK_STALE;
      break;
    default:
      tick->status = CALLIGRAPHY_TICK_DEVICE_FAULT;
  }
  tick->events = 0;
}

}  // namespace

ServoObject::ServoObject(std::shared_ptr<DeviceObject> of, std::shared_ptr<RendererObject> law)
    : device(std::move(of)),
      renderer(std::move(law)),
      servo(*device->device, law_of(*this), virtual_time(renderer->renderer.options().servo_rate)) {}

}  // namespace calligraphy::c

using namespace calligraphy;
using namespace calligraphy::c;

calligraphy_status calligraphy_servo_create(calligraphy_device* device, calligraphy_renderer* renderer,
                                            calligraphy_servo** servo) {
  return guarded([&] {
    target(servo, "servo");
    auto of = shared_object<DeviceObject>(device);
    hand_out(servo, std::make_shared<ServoObject>(std::move(of), shared_object<RendererObject>(renderer)));
  });
}

calligraphy_status calligraphy_servo_step(calligraphy_servo* servo, double now, calligraphy_tick* tick) {
  if (tick) {
    if (const calligraphy_status status = check_tick(tick)) return status;
  }
  auto* const found = find<ServoObject>(servo);
  if (!found) return without_force(tick, refuse_handle(Kind::servo, servo));
  if (!std::isfinite(now)) {
    return without_force(tick, refuse(CALLIGRAPHY_INVALID_VALUE, "now = %g s, must be finite", now));
  }
  found->has_updated = false;
  found->servo.step(now);
  if (!tick) return CALLIGRAPHY_OK;
  write_tick(*found->renderer, tick);
  const Eigen::Vector3d& force = found->device->force();
  to_array(force, tick->force);
  to_array(found->renderer->renderer.mapping().force_to_page(force), tick->page_force);
  if (!found->has_updated) describe_gap(found->servo.status(), tick);
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
    result.device_status = static_cast<std::int32_t>(status.device);
    result.gain = status.gain;
    result.ticks = statistics.ticks;
    result.missed = statistics.missed_deadlines;
    if (status.fault != DeviceFault::none) std::strncpy(result.fault, to_string(status.fault), sizeof result.fault - 1);
    std::strncpy(result.advice, advice_text(status.device), sizeof result.advice - 1);
    write_struct(state, "calligraphy_servo_state", result);
  });
}
