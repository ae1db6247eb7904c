// How a simulated hand raises, carries and lowers a pen, in metres of the page.
#pragma once

namespace calligraphy {

constexpr double raised_height = 0.008;   // pen above the paper between strokes [m]
constexpr double pressed_depth = 0.0025;  // intended depth below the paper while writing [m]
constexpr double lowering_time = 0.2;     // [s]
constexpr double raising_time = 0.12;     // [s]
constexpr double approach_speed = 0.12;   // upper bound of the mean speed in the air [m/s]

}  // namespace calligraphy
