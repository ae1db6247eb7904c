// What a pen senses besides its place: the same for a tablet's pen and the stylus of a haptic device.
#pragma once

#include <cstdint>
#include <limits>

namespace calligraphy {

/// What a pen senses at a moment besides its place, in the axes of its device or of the paper. A quantity that it does
/// not sense is NaN.
///
/// For W3C Pointer Events (Level 3) on a screen in the x-y plane that faces z: `altitude` is altitudeAngle, `azimuth`
/// is -azimuthAngle, and `twist` is minus the event's twist in radians, since the y axis of a screen points down.
struct StylusState {
  double pressure = std::numeric_limits<double>::quiet_NaN();  ///< of the tip, in its full range: 0 to 1 [1]
  double force = std::numeric_limits<double>::quiet_NaN();     ///< of the tip on the paper, where it is known [N]
  double altitude = std::numeric_limits<double>::quiet_NaN();  ///< of the barrel above the x-y plane, up to pi/2 [rad]
  double azimuth = std::numeric_limits<double>::quiet_NaN();   ///< of the barrel: from x towards y [rad]
  double twist = std::numeric_limits<double>::quiet_NaN();     ///< about the barrel, counterclockwise from above [rad]
  double height = std::numeric_limits<double>::quiet_NaN();    ///< of the tip above the paper [m]

  /// Equal to the last bit, or both not sensed.
  bool operator==(const StylusState& other) const noexcept;
};

// Bits of the buttons of a pen, as in W3C Pointer Events.
inline constexpr std::uint32_t tip_button = 1;      ///< the tip is on the paper
inline constexpr std::uint32_t barrel_button = 2;   ///< the button of the barrel is pressed
inline constexpr std::uint32_t eraser_button = 32;  ///< the eraser is on the paper

/// Sets the altitude and the azimuth of a barrel that leans by `tilt_x` towards x in the x-z plane and by `tilt_y`
/// towards y in the y-z plane, from -pi/2 to pi/2 [rad]. The tiltX of a Pointer Event is `tilt_x`, its tiltY
/// is -`tilt_y`. Both become NaN if either tilt is. The azimuth of an upright barrel is 0.
void set_tilt(StylusState& stylus, double tilt_x, double tilt_y) noexcept;

}  // namespace calligraphy
