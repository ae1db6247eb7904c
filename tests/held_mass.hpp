// A mass with viscous damping under a zero-order hold of the force, in closed form: no integration error at any rate.
#pragma once

#include <cmath>

namespace calligraphy_test {

/// m x'' + b x' = F along one axis, b above 0.
class HeldMass {
 public:
  double place = 0.0;  ///< [m]
  double speed = 0.0;  ///< [m/s]

  HeldMass(double mass, double damping, double period)
      : damping_(damping),
        decay_(std::exp(-damping * period / mass)),
        lag_(-mass / damping * std::expm1(-damping * period / mass)),
        period_(period) {}

  /// Holds `force` [N] for one period; returns the displacement [m].
  double advance(double force) {
    const double terminal = force / damping_;
    const double way = terminal * period_ + (speed - terminal) * lag_;
    speed = terminal + (speed - terminal) * decay_;
    place += way;
    return way;
  }

 private:
  double damping_, decay_, lag_, period_;
};

}  // namespace calligraphy_test
