// How a simulated hand raises, carries and lowers a pen, in metres of the page.
#pragma once

namespace calligraphy {

constexpr double raised_height = 0.008;   // pen above the paper between strokes [m]
constexpr double pressed_depth = 0.0025;  // where the hand means to be while writing, below the paper [m]
constexpr double lowering_time = 0.2;     // [s]
constexpr double raising_time = 0.12;     // [s]
constexpr double approach_speed = 0.12;   // mean, in the air, at most [m/s]

}  // namespace calligraphy
