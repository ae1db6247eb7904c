#include <calligraphy/render/haptic_tick.hpp>

#include "base/enum_name.hpp"

namespace calligraphy {

const char* to_string(TickStatus status) noexcept {
  static constexpr const char* names[] = {"ok", "stale", "bad_sample", "device_fault", "bad_clock", "bad_law"};
  return name_of<TickStatus::bad_law>(status, names, "");
}

const char* to_string(WritingHint hint) noexcept {
  static constexpr const char* names[] = {
      "none", "write", "too_far", "at_end", "in_middle", "wrong_direction", "another_stroke", "off_stroke",
      "lift_first", "warm_motors", "lifted_early"};
  return name_of<WritingHint::lifted_early>(hint, names, "");
}

}  // namespace calligraphy
