#include <cmath>

#include <calligraphy/devices/device_profiles.hpp>

#include "conversions.hpp"
#include "objects.hpp"
#include "structs.hpp"

namespace calligraphy::c {
namespace {

GripImpedance grip_of(const calligraphy_grip* given) {
  if (!given) return {};
  const calligraphy_grip grip = read_struct(given, "calligraphy_grip");
  return {grip.mass, grip.damping, grip.stiffness};
}

/// In the coordinates of the paper, which are those of the page divided by the scale.
PointerOptions pointer_options(const calligraphy_pointer_options* given, const MotionMapping& mapping) {
  PointerOptions result;
  if (given) {
    const calligraphy_pointer_options options = read_struct(given, "calligraphy_pointer_options");
    set_if_given(result.rate, options.rate, "rate");
    set_if_given(result.smoothing_time, options.smoothing_time, "smoothing_time");
    set_if_given(result.max_speed, options.max_speed, "max_speed");
    set_if_given(result.lifting_speed, options.lifting_speed, "lifting_speed");
    set_if_given(result.hover_height, options.hover_height, "hover_height");
    set_if_given(result.press_depth, options.press_depth, "press_depth");
  }
  result.paper.linear() = mapping.rotation.transpose();
  result.paper.translation() = mapping.to_device(Eigen::Vector3d::Zero());
  return result;
}

SimulatedDevice& simulated(calligraphy_device* device) {
  SimulatedDevice* const found = object<DeviceObject>(device).simulated;
  if (!found) throw Refusal(CALLIGRAPHY_INVALID_HANDLE, "device: a pointer device, expected a simulated one");
  return *found;
}

}  // namespace
}  // namespace calligraphy::c

using namespace calligraphy;
using namespace calligraphy::c;

calligraphy_status calligraphy_device_profile(const char* name, calligraphy_capabilities* capabilities) {
  return guarded(
      [&] { write_struct(capabilities, "calligraphy_capabilities", to_c(device_profile(&target(name, "name")))); });
}

calligraphy_status calligraphy_simulated_device(const calligraphy_capabilities* capabilities,
                                                const calligraphy_grip* grip, const double* position,
                                                calligraphy_device** device) {
  return guarded([&] {
    target(device, "device");
    auto made = std::make_unique<SimulatedDevice>(capabilities_of(capabilities), grip_of(grip),
                                                  vector_of(position, "position", "m"));
    auto result = std::make_shared<DeviceObject>();
    result->simulated = made.get();
    result->device = std::move(made);
    hand_out(device, std::move(result));
  });
}

calligraphy_status calligraphy_pointer_device(const calligraphy_capabilities* capabilities,
                                              const calligraphy_grip* grip, const calligraphy_pointer_options* options,
                                              const calligraphy_mapping* mapping, calligraphy_device** device) {
  return guarded([&] {
    target(device, "device");
    const MotionMapping page = mapping_of(mapping);
    auto made =
        std::make_unique<PointerDevice>(capabilities_of(capabilities), grip_of(grip), pointer_options(options, page));
    auto result = std::make_shared<DeviceObject>();
    result->pointer = made.get();
    result->device = std::move(made);
    result->scale = page.scale;
    hand_out(device, std::move(result));
  });
}

calligraphy_status calligraphy_device_point(calligraphy_device* device, double x, double y, double pressure,
                                            uint32_t buttons) {
  const auto* const found = find<DeviceObject>(device);
  if (!found) return refuse_handle(Kind::device, device);
  if (!found->pointer) {
    return refuse(CALLIGRAPHY_INVALID_HANDLE, "device: a simulated device, expected a pointer device");
  }
  if (!std::isfinite(x) || !std::isfinite(y) || !(pressure >= 0.0 && pressure <= 1.0)) {
    return refuse(CALLIGRAPHY_INVALID_VALUE,
                  "pointer at (%g, %g) m with pressure %g, must be finite and within 0 and 1", x, y, pressure);
  }
  found->pointer->move(x / found->scale, y / found->scale, pressure, buttons);
  return CALLIGRAPHY_OK;
}

calligraphy_status calligraphy_device_intend(calligraphy_device* device, const double* position,
                                             const double* velocity) {
  return guarded([&] {
    Intention intention;
    intention.position = vector_of(position, "position", "m");
    if (velocity) intention.velocity = vector_of(velocity, "velocity", "m/s");
    simulated(device).set_intention(intention);
  });
}

calligraphy_status calligraphy_device_advance(calligraphy_device* device, double seconds) {
  return guarded([&] { simulated(device).advance(seconds); });
}

calligraphy_status calligraphy_device_read(calligraphy_device* device, calligraphy_device_state* state) {
  const auto* const found = find<DeviceObject>(device);
  if (!found) return refuse_handle(Kind::device, device);
  if (const calligraphy_status status = check_result(state, "calligraphy_device_state")) return status;
  const std::uint32_t size = state->size;
  *state = to_c(found->device->read());
  state->size = size;
  clear_rest(state);
  return CALLIGRAPHY_OK;
}

calligraphy_status calligraphy_device_write(calligraphy_device* device, const double* force) {
  const auto* const found = find<DeviceObject>(device);
  if (!found) return refuse_handle(Kind::device, device);
  if (!force) return refuse(CALLIGRAPHY_INVALID_VALUE, "force is null");
  const Eigen::Vector3d commanded(force[0], force[1], force[2]);
  found->device->write(commanded);
  if (commanded.allFinite()) return CALLIGRAPHY_OK;
  return refuse(CALLIGRAPHY_INVALID_VALUE, "force = (%g, %g, %g) N, must be finite: it counts as zero", force[0],
                force[1], force[2]);
}
