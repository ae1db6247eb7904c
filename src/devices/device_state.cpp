#include <calligraphy/devices/device_state.hpp>

namespace calligraphy {

const char* to_string(DeviceStatus status) noexcept {
  switch (status) {
    case DeviceStatus::ok:
      return "ok";
    case DeviceStatus::stale:
      return "stale";
    case DeviceStatus::disconnected:
      return "disconnected";
    case DeviceStatus::warm_motors:
      return "warm motors";
    case DeviceStatus::needs_calibration:
      return "needs calibration";
    case DeviceStatus::fault:
      return "fault";
  }
  return "unknown";
}

const char* advice_text(DeviceStatus status) noexcept {
  switch (status) {
    case DeviceStatus::needs_calibration:
      return "needs calibration: put the pen into the inkwell, or calibrate it as the device's manual says";
    case DeviceStatus::warm_motors:
      return "warm motors: the force is lowered until they have cooled, to none if need be; let the device rest";
    default:
      return "";
  }
}

const char* to_string(DeviceFault fault) noexcept {
  switch (fault) {
    case DeviceFault::none:
      return "none";
    case DeviceFault::unplugged:
      return "unplugged";
    case DeviceFault::stalled:
      return "stalled";
    case DeviceFault::timed_out:
      return "timed out";
    case DeviceFault::link_error:
      return "link error";
    case DeviceFault::empty_frame:
      return "empty frame";
    case DeviceFault::short_frame:
      return "short frame";
    case DeviceFault::overlong_frame:
      return "overlong frame";
    case DeviceFault::corrupted_frame:
      return "corrupted frame";
    case DeviceFault::lost_frames:
      return "lost frames";
    case DeviceFault::repeated_frames:
      return "repeated frames";
    case DeviceFault::stuck_encoder:
      return "stuck encoder";
    case DeviceFault::leaping_encoder:
      return "leaping encoder";
    case DeviceFault::outside_workspace:
      return "outside the workspace";
    case DeviceFault::silent:
      return "silent";
    case DeviceFault::overheated:
      return "overheated";
    case DeviceFault::runtime_error:
      return "runtime error";
    case DeviceFault::slow_force_law:
      return "slow force law";
    case DeviceFault::bad_force:
      return "bad force";
    case DeviceFault::late_clock:
      return "late clock";
    case DeviceFault::emergency_stop:
      return "emergency stop";
    case DeviceFault::uncalibrated:
      return "not calibrated";
    case DeviceFault::device_error:
      return "device error";
  }
  return "unknown";
}

}  // namespace calligraphy
