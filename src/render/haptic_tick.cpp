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

const char* to_string(WritingHint hint) noexcept {
  switch (hint) {
    case WritingHint::none:
      return "";
    case WritingHint::write:
      return "write on";
    case WritingHint::too_far:
      return "too far from the start";
    case WritingHint::at_end:
      return "at the stroke's end";
    case WritingHint::in_middle:
      return "in the middle of the stroke";
    case WritingHint::wrong_direction:
      return "wrong direction";
    case WritingHint::another_stroke:
      return "another stroke's start";
    case WritingHint::off_stroke:
      return "too far from the stroke";
    case WritingHint::lift_first:
      return "lift the pen first";
  }
  return "";
}

}  // namespace calligraphy
