// What the motors can sustain: the peak force for a while, the continuous force indefinitely.
#pragma once

#include <algorithm>
#include <cmath>

namespace calligraphy {

/// A first-order model of motor heating: driven by the square of the force, in equilibrium at the continuous force,
/// with time constant `time_constant`. The permitted force falls from the peak to the continuous force over the last
/// fifth of the heat range, so it never steps, and the heat never exceeds that of the continuous force.
struct ThermalBudget {
  double peak = 0.0;           ///< [N]
  double continuous = 0.0;     ///< [N]
  double time_constant = 0.0;  ///< [s]
  double heat = 0.0;           ///< 1: in equilibrium at the continuous force [1]
  double last_seconds = 0.0;   ///< for which a force was held last [s]
  double last_share = 0.0;     ///< of the way to equilibrium that it went in that time [1]

  double max_force() const noexcept {
    constexpr double warm = 0.8;
    const double share = std::clamp((1.0 - heat) / (1.0 - warm), 0.0, 1.0);
    return share > 0.0 ? continuous + share * (peak - continuous) : continuous;  // the peak may be infinite
  }
  /// Accounts for `force` [N] held for `seconds`.
  void held(double force, double seconds) noexcept {
    if (seconds != last_seconds) {
      last_seconds = seconds;
      last_share = -std::expm1(-seconds / time_constant);
    }
    const double ratio = std::min(force / continuous, 1e6);
    heat += (ratio * ratio - heat) * last_share;
  }
};

}  // namespace calligraphy
