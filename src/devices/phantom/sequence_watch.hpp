// Judges the sequence numbers of reports.
#pragma once

#include <cstdint>

#include <calligraphy/devices/device_state.hpp>

namespace calligraphy::phantom {

/// One or two reports lost in a row are made good by the next: the gap is that of an ordinary pause of a real device.
/// More in a row is a fault, and so is a link that loses more than one in fifty all the time. A report that comes twice
/// is dropped; from the third time on the device is taken to stand still.
class SequenceWatch {
 public:
  struct Answer {
    std::int64_t steps = 1;  ///< reports since the last one that was fresh, this one included
    bool fresh = true;       ///< to be used
    DeviceFault fault = DeviceFault::none;
  };

  explicit SequenceWatch(int bits) noexcept : bits_(bits) {}

  Answer judge(std::uint32_t shown) noexcept;
  /// The next number is right whatever it is.
  void restart() noexcept { started_ = false; }

 private:
  static constexpr std::int64_t lost_in_a_row = 3;
  static constexpr int repeats_in_a_row = 3;
  static constexpr double forgiven = 0.02;  ///< of a lost report, by each that arrives
  static constexpr double most_debt = 10.0;

  int bits_;
  bool started_ = false;
  std::uint32_t last_ = 0;
  int repeats_ = 0;
  double debt_ = 0.0;  ///< lost reports that are not forgiven yet
};

}  // namespace calligraphy::phantom
