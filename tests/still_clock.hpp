// A work clock for servos in virtual time, so that no test depends on how busy the machine is.
#pragma once

#include <calligraphy/devices/servo.hpp>

namespace calligraphy_test {

inline double still_clock() noexcept { return 0.0; }

/// The default options, with a work clock that stands still.
inline calligraphy::ServoOptions untimed(calligraphy::ServoOptions options = {}) {
  options.work_clock = still_clock;
  return options;
}

}  // namespace calligraphy_test
