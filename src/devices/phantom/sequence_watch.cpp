#include "sequence_watch.hpp"

#include <algorithm>

#include "devices/phantom/wire/wrapping_count.hpp"

namespace calligraphy::phantom {

SequenceWatch::Result SequenceWatch::check(std::uint32_t shown) noexcept {
  const std::int64_t steps = started_ ? min_step(last_, shown, bits_) : 1;
  started_ = true;
  last_ = shown;
  if (steps == 0) {
    repeats_ = std::min(repeats_ + 1, repeats_in_a_row);
    return {0, false, repeats_ < repeats_in_a_row ? DeviceFault::none : DeviceFault::repeated_frames};
  }
  repeats_ = 0;
  if (steps < 0) return {0, false, DeviceFault::repeated_frames};
  const std::int64_t lost = steps - 1;
  debt_ = std::min(std::max(debt_ - forgiven, 0.0) + static_cast<double>(lost), max_debt + 1.0);
  const bool too_many = lost >= lost_in_a_row || debt_ > max_debt;
  return {steps, true, too_many ? DeviceFault::lost_frames : DeviceFault::none};
}

}  // namespace calligraphy::phantom
