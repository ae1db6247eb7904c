// How a simulated hand moves a pen: raises, carries and lowers it, in metres of the page.
#pragma once

#include <algorithm>
#include <cmath>

#include <calligraphy/base/stylus_state.hpp>

namespace calligraphy {

constexpr double raised_height = 0.008;   // pen above the paper between strokes [m]
constexpr double pressed_depth = 0.0025;  // intended depth below the paper while writing [m]
constexpr double lowering_time = 0.2;     // [s]
constexpr double raising_time = 0.12;     // [s]
constexpr double approach_speed = 0.12;   // upper bound of the mean speed in the air [m/s]

/// Share of its way that a hand has covered after a share of the time, with minimum jerk (Flash and Hogan 1985).
inline double minimum_jerk(double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  return t * t * t * (10.0 + t * (-15.0 + 6.0 * t));
}

/// What the pen of a simulated hand senses that means to be at this height above the paper [m], in the steps of a
/// tablet: half its pressure while writing, its height in the air.
inline StylusState sensed_at(double height) {
  constexpr double pressures = 8192.0, heights = 1e4;  // steps in its full range, and in a metre
  StylusState stylus;
  stylus.pressure = std::round(std::clamp(-height / (2.0 * pressed_depth), 0.0, 1.0) * pressures) / pressures;
  stylus.height = std::round(std::max(height, 0.0) * heights) / heights;
  return stylus;
}

}  // namespace calligraphy
