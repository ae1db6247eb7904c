// Motion of a point mass with dry friction along one axis, between two samples.
#pragma once

#include "oscillator.hpp"

namespace calligraphy {

struct AxisState {
  double position = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]
};

/// Forces on the axis, in addition to the oscillator's own spring and damper.
struct AxisLoad {
  double force = 0.0;            ///< held constant; includes the grip damping times target_velocity [N]
  double target = 0.0;           ///< rest position of the spring at the start [m]
  double target_velocity = 0.0;  ///< [m/s]
  double dry_friction = 0.0;     ///< Coulomb friction: opposes motion, or holds the mass up to this force [N]
};

/// Maximum number of sliding phases that one call computes exactly, more than any step of a servo loop contains. Beyond
/// it the axis stays at its last stop, so the work is bounded for any step.
inline constexpr int max_phases = 256;

/// Exact motion over `seconds`: m x'' = force + k (target(t) - x) - d x' - dry friction. While the velocity keeps its
/// sign the equation is linear and solved in closed form; at each stop the mass sticks or reverses.
/// `whole_step` is oscillator.impulse_response(seconds), which several axes can share.
AxisState advance_axis(const Oscillator& oscillator, const ImpulseResponse& whole_step, AxisState start,
                       const AxisLoad& load, double seconds) noexcept;

}  // namespace calligraphy
