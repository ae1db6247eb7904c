// Options of a passivity controller: what it may do, and what it must know of the device and the loop.
#pragma once

#include <limits>

namespace calligraphy {

/// What a passivity controller may do, and what it must know of the device and the loop.
struct PassivityOptions {
  double max_damping = 0.0;  ///< maximum damping injected; 0: no control [N s/m]
  /// Maximum net energy delivered to the hand since the start. Infinite: no limit [J].
  double energy_budget = std::numeric_limits<double>::infinity();
  double mass = std::numeric_limits<double>::infinity();  ///< with a budget: of the device, the lightest pen [kg]
  double hand_speed = 2.0;  ///< with a budget: maximum speed at which a hand moves the pen [m/s]
  double max_gap = 0.016;   ///< with a budget: longest time for which a force is held without a fresh sample [s]
  double scale = 1.0;       ///< K_S (MotionMapping): forces are 1 / scale, speeds scale times those of the device
  int delay = 0;            ///< age of a sample when it is read, at most PassivityController::max_delay [ticks]
};

}  // namespace calligraphy
