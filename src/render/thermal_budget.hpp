// What the motors can sustain: the peak force for a while, the continuous force indefinitely.
#pragma once

#include <algorithm>
#include <cmath>

namespace calligraphy {

/// A first-order model of motor heating: driven by the square of the force, in equilibrium at the continuous force,
/// with time constant `time_constant`. The permitted force is the largest one that can still fall to the continuous
/// force at a relative rate of 1 / time_constant [1/s] before the heat exceeds 1: c (1 + sqrt(1 - h)), at most twice
/// the continuous force c (docs/stability-derivation.md). With 10 s, it thus gives way under a leaning hand by 10 % per
/// second, about the least difference that a hand can feel, and not in a moment.
struct ThermalBudget {
  double peak = 0.0;           ///< [N]
  double continuous = 0.0;     ///< [N]
  double time_constant = 0.0;  ///< [s]
  double heat = 0.0;           ///< 1: in equilibrium at the continuous force [1]
  double last_seconds = 0.0;   ///< for which the last force was held [s]
  double last_share = 0.0;     ///< of the way to equilibrium that the heat covers in that time [1]

  double max_force() const noexcept {
    return std::min(peak, continuous * (1.0 + std::sqrt(std::max(1.0 - heat, 0.0))));
  }
  /// The heat takes a tenth or more of what cold motors may do.
  bool is_warm() const noexcept { return peak > 0.0 && max_force() < 0.9 * std::min(peak, 2.0 * continuous); }
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
