// Assistance as needed: it fades as the writer improves and returns when errors grow.
#pragma once

#include <algorithm>

namespace calligraphy {

/// Assistance as needed. After each stroke the assistance, a factor a on the guidance, becomes a <- retention a + (1 -
/// retention) error / full_assistance_error, clamped to [min_assistance, 1]: the law of Emken, Bobrow and Reinkensmeyer
/// 2005 ("Robotic movement training as an optimization problem"), the optimum for a trainer that minimises both error
/// and assistance. With perfect strokes the assistance decays as retention^n; with a constant error e it converges to e
/// / full_assistance_error. An abandoned stroke counts as an error of at least full_assistance_error.
struct AssistPolicy {
  bool enabled = false;                 ///< false: full assistance always
  double retention = 0.8;               ///< share of the previous assistance that is retained [1]
  double full_assistance_error = 0.05;  ///< RMS lateral error of a stroke that keeps the assistance at 1 [em]
  double min_assistance = 0.1;          ///< lower bound of the assistance [1]

  /// Assistance for the next stroke, after one with this RMS lateral error [em].
  double next(double assistance, double error) const noexcept {
    return std::clamp(retention * assistance + (1.0 - retention) * error / full_assistance_error, min_assistance, 1.0);
  }
};

}  // namespace calligraphy
