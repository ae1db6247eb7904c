// Random faults between a device and its renderer.
#pragma once

#include <cstdint>

#include <calligraphy/devices/device_state.hpp>

#include "hard_cases.hpp"

namespace calligraphy_test {

/// Tampers with samples: at random intervals a fault of a random kind begins and lasts for some ticks.
class Faults {
 public:
  explicit Faults(std::uint64_t seed) : random_(seed) {}

  /// The sample as received by the renderer.
  calligraphy::DeviceState tamper(const calligraphy::DeviceState& state);

  std::uint64_t count() const { return count_; }                           ///< number of faults so far
  bool force_is_lost() const { return left_ > 0 && kind_ == Kind::gone; }  ///< written forces are lost

 private:
  enum class Kind {
    not_finite,
    frozen,
    leap,
    sign_flip,
    one_axis,
    flipped_bits,
    gone,
    status,
    time_still,
    time_back,
    time_leap,
    late,
    jitter,
    buttons,
    number_of_kinds
  };
  void begin(const calligraphy::DeviceState& state);

  Sequence random_;
  Kind kind_ = Kind::frozen;
  int left_ = 0;
  std::uint64_t count_ = 0;
  int axis_ = 0;
  double clock_offset_ = 0.0;  ///< [s]
  calligraphy::DeviceState held_;
};

}  // namespace calligraphy_test
