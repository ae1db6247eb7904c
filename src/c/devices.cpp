#include <algorithm>
#include <cmath>
#include <utility>

#include <calligraphy/devices/device_profiles.hpp>

#include "conversions.hpp"
#include "host_device.hpp"
#include "objects.hpp"
#include "structs.hpp"

namespace calligraphy::c {
namespace {

GripImpedance grip_of(const calligraphy_grip* given) {
  if (!given) return {};
  const calligraphy_grip grip = read_struct(given, "calligraphy_grip");
  return {grip.mass, grip.damping, grip.stiffness};
}

/// Options in paper coordinates, which are those of the page divided by the scale.
PointerOptions pointer_options(const calligraphy_pointer_options* given, const MotionMapping& mapping) {
  PointerOptions result;
  if (given) {
    const calligraphy_pointer_options options = read_struct(given, "calligraphy_pointer_options");
    set_if_given(result.rate, options.rate, "rate", "Hz");
    set_if_given(result.smoothing_time, options.smoothing_time, "smoothing_time", "s");
    set_if_given(result.max_speed, options.max_speed, "max_speed", "m/s");
    set_if_given(result.lifting_speed, options.lifting_speed, "lifting_speed", "m/s");
    set_if_given(result.hover_height, options.hover_height, "hover_height", "m");
    set_if_given(result.press_depth, options.press_depth, "press_depth", "m");
  }
  result.paper.linear() = mapping.rotation.transpose();
  result.paper.translation() = mapping.to_device(Eigen::Vector3d::Zero());
  return result;
}

template <class Device>
constexpr const char* kind_name = nullptr;
template <>
constexpr const char* kind_name<SimulatedDevice> = "simulated";
template <>
constexpr const char* kind_name<PointerDevice> = "pointer";
template <>
constexpr const char* kind_name<HostDevice> = "host";

/// The device if it is of this kind; otherwise null, with the last error set. Does not allocate.
template <class Device>
Device* find_device(const calligraphy_device* handle) noexcept {
  const auto* const found = find<DeviceObject>(handle);
  auto* const device = found ? dynamic_cast<Device*>(found->device.get()) : nullptr;
  if (!found) {
    refuse_handle(Kind::device, handle);
  } else if (!device) {
    refuse(CALLIGRAPHY_INVALID_HANDLE, "device: expected one of calligraphy_%s_device_create()", kind_name<Device>);
  }
  return device;
}

/// As find_device(), for set-up. @throws Refusal
template <class Device>
Device& device_of(const calligraphy_device* handle) {
  Device* const found = find_device<Device>(handle);
  if (!found) throw_refused(CALLIGRAPHY_INVALID_HANDLE);
  return *found;
}

/// As find_device(), for any device that the library itself reads and writes.
HapticDevice* find_readable_device(const calligraphy_device* handle) noexcept {
  const auto* const found = find<DeviceObject>(handle);
  if (!found) {
    refuse_handle(Kind::device, handle);
  } else if (dynamic_cast<HostDevice*>(found->device.get())) {
    refuse(CALLIGRAPHY_INVALID_HANDLE,
           "device: one of calligraphy_host_device_create() is read and written by the program");
  } else {
    return found->device.get();
  }
  return nullptr;
}

void hand_out_device(calligraphy_device** handle, std::unique_ptr<HapticDevice> device, double scale = 1.0) {
  auto object = std::make_shared<DeviceObject>();
  object->device = std::move(device);
  object->scale = scale;
  hand_out(handle, std::move(object));
}

}  // namespace

const Eigen::Vector3d& DeviceObject::force() const noexcept {
  if (const auto* simulated = dynamic_cast<const SimulatedDevice*>(device.get())) return simulated->applied_force();
  if (const auto* pointer = dynamic_cast<const PointerDevice*>(device.get())) return pointer->device().applied_force();
  return static_cast<const HostDevice&>(*device).force();
}

}  // namespace calligraphy::c

using namespace calligraphy;
using namespace calligraphy::c;

calligraphy_status calligraphy_device_profile(const char* name, calligraphy_capabilities* capabilities) {
  return guarded(
      [&] { write_struct(capabilities, "calligraphy_capabilities", to_c(device_profile(&target(name, "name")))); });
}

calligraphy_status calligraphy_simulated_device_create(const calligraphy_capabilities* capabilities,
                                                       const calligraphy_grip* grip, const double* position,
                                                       calligraphy_device** device) {
  return guarded([&] {
    target(device, "device");
    hand_out_device(device, std::make_unique<SimulatedDevice>(capabilities_of(capabilities), grip_of(grip),
                                                              vector_of(position, "position", "m")));
  });
}

calligraphy_status calligraphy_pointer_device_create(const calligraphy_capabilities* capabilities,
                                                     const calligraphy_grip* grip,
                                                     const calligraphy_pointer_options* options,
                                                     const calligraphy_mapping* mapping, calligraphy_device** device) {
  return guarded([&] {
    target(device, "device");
    const MotionMapping page = mapping_of(mapping);
    hand_out_device(
        device,
        std::make_unique<PointerDevice>(capabilities_of(capabilities), grip_of(grip), pointer_options(options, page)),
        page.scale);
  });
}

calligraphy_status calligraphy_host_device_create(const calligraphy_capabilities* capabilities,
                                                  calligraphy_device** device) {
  return guarded([&] {
    target(device, "device");
    hand_out_device(device, std::make_unique<HostDevice>(capabilities_of(capabilities)));
  });
}

calligraphy_status calligraphy_device_move_pointer(calligraphy_device* device, double x, double y, double pressure,
                                                   uint32_t buttons) {
  return calligraphy_device_move_pen(device, x, y, pressure, buttons, nullptr);
}

calligraphy_status calligraphy_device_move_pen(calligraphy_device* device, double x, double y, double pressure,
                                               uint32_t buttons, const calligraphy_stylus* stylus) {
  auto* const pointer = find_device<PointerDevice>(device);
  if (!pointer) return CALLIGRAPHY_INVALID_HANDLE;
  if (!std::isfinite(x) || !std::isfinite(y) || !(pressure >= 0.0 && pressure <= 1.0)) {
    return refuse(CALLIGRAPHY_INVALID_VALUE,
                  "pointer at (%g, %g) m with pressure %g, must be finite and within 0 and 1", x, y, pressure);
  }
  StylusState sensed;
  if (const calligraphy_status status = read_stylus(stylus, sensed)) return status;
  const double scale = find<DeviceObject>(device)->scale;
  pointer->move(x / scale, y / scale, pressure, buttons, sensed);
  return CALLIGRAPHY_OK;
}

calligraphy_status calligraphy_device_intend(calligraphy_device* device, const double* position,
                                             const double* velocity) {
  return guarded([&] {
    auto& simulated = device_of<SimulatedDevice>(device);
    Intention intention;
    intention.position = vector_of(position, "position", "m");
    if (velocity) intention.velocity = vector_of(velocity, "velocity", "m/s");
    simulated.set_intention(intention);
  });
}

calligraphy_status calligraphy_device_advance(calligraphy_device* device, double seconds) {
  return guarded([&] { device_of<SimulatedDevice>(device).advance(seconds); });
}

calligraphy_status calligraphy_device_read(calligraphy_device* device, calligraphy_device_state* state) {
  HapticDevice* const found = find_readable_device(device);
  if (!found) return CALLIGRAPHY_INVALID_HANDLE;
  if (const calligraphy_status status = check_size(state, "calligraphy_device_state")) return status;
  put_struct(state, to_c(found->read()));
  return CALLIGRAPHY_OK;
}

calligraphy_status calligraphy_device_write(calligraphy_device* device, const double* force) {
  HapticDevice* const found = find_readable_device(device);
  if (!found) return CALLIGRAPHY_INVALID_HANDLE;
  if (!force) return refuse(CALLIGRAPHY_INVALID_VALUE, "force is null");
  const Eigen::Vector3d commanded(force[0], force[1], force[2]);
  found->write(commanded);
  if (commanded.allFinite()) return CALLIGRAPHY_OK;
  return refuse(CALLIGRAPHY_INVALID_VALUE, "force = (%g, %g, %g) N, must be finite: it counts as zero", force[0],
                force[1], force[2]);
}

calligraphy_status calligraphy_device_supply(calligraphy_device* device, const calligraphy_device_state* state) {
  auto* const host = find_device<HostDevice>(device);
  if (!host) return CALLIGRAPHY_INVALID_HANDLE;
  if (const calligraphy_status status = check_given(state, "calligraphy_device_state")) return status;
  host->supply(state_of(state));
  return CALLIGRAPHY_OK;
}
