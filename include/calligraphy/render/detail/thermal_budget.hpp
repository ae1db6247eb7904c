// What the motors can bear: the peak for a while, the continuous force for ever.
#pragma once

#include <algorithm>
#include <cmath>

namespace calligraphy {

/// A first-order model of the motors' heat: it is fed by the square of the force, in balance at the continuous force,
/// and answers with `time_constant`. The largest force falls from the peak to the continuous one over the last fifth of
/// the way, so that it never steps; with it heat never passes that of the continuous force.
struct ThermalBudget {
  double peak = 0.0;           ///< [N]
  double continuous = 0.0;     ///< [N]
  double time_constant = 0.0;  ///< [s]
  double heat = 0.0;           ///< 1: that of the continuous force, for ever [1]

  double max_force() const noexcept {
    constexpr double warm = 0.8;
    const double share = std::clamp((1.0 - heat) / (1.0 - warm), 0.0, 1.0);
    return share > 0.0 ? continuous + share * (peak - continuous) : continuous;  // the peak may be infinite
  }
  /// `force` [N] was held for `seconds`.
  void held(double force, double seconds) noexcept {
    const double ratio = std::min(force / continuous, 1e6);
    heat += (ratio * ratio - heat) * -std::expm1(-seconds / time_constant);
  }
};

}  // namespace calligraphy
