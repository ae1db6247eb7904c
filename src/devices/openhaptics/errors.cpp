#include "errors.hpp"

#include <cstdio>

#include <calligraphy/devices/openhaptics/openhaptics_device.hpp>

namespace calligraphy::hdapi {
namespace {

struct KnownError {
  ErrorCode code;
  const char* name;
  Diagnosis diagnosis;
};

constexpr KnownError known_errors[] = {
    {no_error, "no error", {DeviceStatus::ok, DeviceFault::none}},
    {warm_motors, "warm motors", {DeviceStatus::warm_motors, DeviceFault::none}},
    {exceeded_max_force, "maximum force exceeded", {DeviceStatus::fault, DeviceFault::runtime_error}},
    {exceeded_impulse, "force impulse limit exceeded", {DeviceStatus::fault, DeviceFault::runtime_error}},
    {exceeded_velocity, "velocity limit exceeded", {DeviceStatus::fault, DeviceFault::runtime_error}},
    {force_error, "force error", {DeviceStatus::fault, DeviceFault::runtime_error}},
    {device_fault, "device fault", {DeviceStatus::fault, DeviceFault::device_error}},
    {comm_error, "communication error", {DeviceStatus::disconnected, DeviceFault::link_error}},
    {comm_config_error, "communication configuration error", {DeviceStatus::disconnected, DeviceFault::link_error}},
    {timer_error, "timer error", {DeviceStatus::fault, DeviceFault::timed_out}},
    {frame_error, "frame error", {DeviceStatus::fault, DeviceFault::runtime_error}},
};

unsigned group_of(ErrorCode code) noexcept { return code >> 8; }

const KnownError* find(ErrorCode code) noexcept {
  for (const KnownError& known : known_errors) {
    if (known.code == code) return &known;
  }
  return nullptr;
}

int gravity(DeviceStatus status) noexcept {
  constexpr int of_status[] = {0, 2, 5, 1, 3, 4};  // ok, stale, disconnected, warm_motors, needs_calibration, fault
  return of_status[static_cast<std::size_t>(status)];
}

}  // namespace

Diagnosis diagnose(ErrorCode code) noexcept {
  const KnownError* known = find(code);
  return known != nullptr ? known->diagnosis : Diagnosis{DeviceStatus::fault, DeviceFault::runtime_error};
}

bool concerns_call(ErrorCode code) noexcept { return group_of(code) == 1 && code != invalid_operation; }

bool prevents_start(ErrorCode code) noexcept {
  constexpr unsigned forces = 2, frames = 4;
  return !concerns_call(code) && group_of(code) != forces && group_of(code) != frames;
}

Diagnosis more_severe(const Diagnosis& a, const Diagnosis& b) noexcept {
  return gravity(b.status) > gravity(a.status) ? b : a;
}

}  // namespace calligraphy::hdapi

std::string calligraphy::openhaptics_error_name(std::uint32_t code) {
  if (const auto* known = hdapi::find(code)) return known->name;
  char name[24];
  std::snprintf(name, sizeof name, "error 0x%04x", code);
  return name;
}
