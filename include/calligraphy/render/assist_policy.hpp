// Assistance as needed: it fades as the writer improves and returns when errors grow.
#pragma once

#include <algorithm>

namespace calligraphy {

/// From stroke to stroke the share of the guidance is  a <- retention a + (1 - retention) error /
/// full_assistance_error, within [min_assistance, 1]: the law of Emken, Bobrow and Reinkensmeyer 2005 ("Robotic
/// movement training as an optimization problem"), which is what a trainer does who minimises both the error and the
/// assistance. With perfect writing assistance decays as retention^n; with an error held at e it settles at e /
/// full_assistance_error. A stroke that was given up counts as one with full_assistance_error.
struct AssistPolicy {
  bool enabled = false;                  ///< false: full assistance always
  double retention = 0.8;                ///< of the last stroke's assistance [1]
  double full_assistance_error = 0.002;  ///< RMS lateral error of a stroke that keeps assistance at full [m]
  double min_assistance = 0.1;           ///< assistance never falls below [1]

  double next(double assistance, double error) const noexcept {
    return std::clamp(retention * assistance + (1.0 - retention) * error / full_assistance_error, min_assistance, 1.0);
  }
};

}  // namespace calligraphy
