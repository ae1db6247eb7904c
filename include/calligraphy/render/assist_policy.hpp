// Help as needed: it fades as the writer improves and returns when errors grow.
#pragma once

#include <algorithm>

namespace calligraphy {

/// From stroke to stroke the share of the guidance is  a <- retention a + (1 - retention) error / full_help_error,
/// within [least, 1]: the law of Emken, Bobrow and Reinkensmeyer 2005 ("Robotic movement training as an optimization
/// problem"), which is what a trainer does who minimises both the error and the help. With perfect writing help decays
/// as retention^n; with an error held at e it settles at e / full_help_error. A stroke that was given up counts as one
/// with full_help_error.
struct AssistPolicy {
  bool enabled = false;            ///< false: full help always
  double retention = 0.8;          ///< of the last stroke's help [1]
  double full_help_error = 0.002;  ///< RMS lateral error of a stroke that keeps help at full [m]
  double least = 0.1;              ///< help never falls below [1]

  double next(double help, double error) const noexcept {
    return std::clamp(retention * help + (1.0 - retention) * error / full_help_error, least, 1.0);
  }
};

}  // namespace calligraphy
