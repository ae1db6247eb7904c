#include <calligraphy/devices/device_state.hpp>

#include "base/enum_name.hpp"

namespace calligraphy {

const char* to_string(DeviceStatus status) noexcept {
  static constexpr const char* names[] = {"ok", "stale", "disconnected", "warm motors", "needs calibration", "fault"};
  return name_of<DeviceStatus::fault>(status, names, "unknown");
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
  static constexpr const char* names[] = {
      "none", "unplugged", "stalled", "timed out", "link error", "empty frame", "short frame", "overlong frame",
      "corrupted frame", "lost frames", "repeated frames", "stuck encoder", "leaping encoder", "outside the workspace",
      "silent", "overheated", "runtime error", "slow force law", "bad force", "late clock", "emergency stop",
      "not calibrated", "device error"};
  return name_of<DeviceFault::device_error>(fault, names, "unknown");
}

}  // namespace calligraphy
