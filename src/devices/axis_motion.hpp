// One axis of a point mass with dry friction, between two samples.
#pragma once

#include "oscillator.hpp"

namespace calligraphy {

struct AxisState {
  double position = 0.0;  ///< [m]
  double velocity = 0.0;  ///< [m/s]
};

/// What acts on the axis besides the oscillator's own spring and damper.
struct AxisLoad {
  double force = 0.0;            ///< held, damping of the hand against its moving target included [N]
  double target = 0.0;           ///< rest position of the spring at the start [m]
  double target_velocity = 0.0;  ///< [m/s]
  double dry_friction = 0.0;     ///< largest friction that opposes motion or holds against it [N]
};

/// Phases of sliding that one call follows exactly. More fit into no step of a servo loop; past it the axis is held at
/// its last stop, so that the work is bounded whatever the step.
inline constexpr int max_phases = 256;

/// Exact motion through `seconds`: m x'' = force + k (target(t) - x) - d x' - dry friction. While the velocity keeps
/// its sign the equation is linear and solved in closed form; at each stop the mass sticks or turns back.
/// `whole_step` is oscillator.impulse_response(seconds), which several axes can share.
AxisState advance_axis(const Oscillator& oscillator, const ImpulseResponse& whole_step, AxisState start,
                       const AxisLoad& load, double seconds) noexcept;

}  // namespace calligraphy
