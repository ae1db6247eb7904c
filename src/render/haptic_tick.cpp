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
    case TickStatus::bad_clock:
      return "bad_clock";
    case TickStatus::bad_law:
      return "bad_law";
  }
  return "";
}

const char* to_string(WritingHint hint) noexcept {
  switch (hint) {
    case WritingHint::none:
      return "none";
    case WritingHint::write:
      return "write";
    case WritingHint::too_far:
      return "too_far";
    case WritingHint::at_end:
      return "at_end";
    case WritingHint::in_middle:
      return "in_middle";
    case WritingHint::wrong_direction:
      return "wrong_direction";
    case WritingHint::another_stroke:
      return "another_stroke";
    case WritingHint::off_stroke:
      return "off_stroke";
    case WritingHint::lift_first:
      return "lift_first";
    case WritingHint::warm_motors:
      return "warm_motors";
  }
  return "";
}

}  // namespace calligraphy
