#include <calligraphy/render/haptic_tick.hpp>

namespace calligraphy {

const char* to_string(TickStatus status) noexcept {
  switch (status) {
    case TickStatus::ok:
      return "ok";
    case TickStatus::stale:
      return "stale";
    case TickStatus::bad_sample:
      return "bad_sample";
    case TickStatus::device_fault:
      return "device_fault";
  }
  return "";
}

}  // namespace calligraphy
