// Checks the sequence numbers of reports.
#pragma once

#include <cstdint>

#include <calligraphy/devices/device_state.hpp>

namespace calligraphy::phantom {

/// One or two consecutive lost reports are tolerated: the gap is no longer than a normal pause of a real device. More
/// are a fault, as is a link that persistently loses more than one report in fifty. A repeated report is dropped; from
/// the third repetition on it is a fault.
class SequenceWatch {
 public:
  struct Result {
    std::int64_t steps = 1;  ///< reports since the last fresh one, including this one
    bool fresh = true;       ///< the report is to be used
    DeviceFault fault = DeviceFault::none;
  };

  explicit SequenceWatch(int bits) noexcept : bits_(bits) {}

  Result check(std::uint32_t shown) noexcept;
  /// Accepts any number next.
  void restart() noexcept { started_ = false; }

 private:
  static constexpr std::int64_t lost_in_a_row = 3;
  static constexpr int repeats_in_a_row = 3;
  static constexpr double forgiven = 0.02;  ///< fraction of a lost report that each arriving report makes up for
  static constexpr double max_debt = 10.0;

  int bits_;
  bool started_ = false;
  std::uint32_t last_ = 0;
  int repeats_ = 0;
  double debt_ = 0.0;  ///< lost reports not yet made up for
};

}  // namespace calligraphy::phantom
