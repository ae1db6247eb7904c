// What is wrong with a sample of a pen trace.
#pragma once

#include <string>

#include <calligraphy/judge/pen_trace.hpp>

namespace calligraphy {

/// Why a sample cannot be in a file after one of this time [s], in words that follow its place, as in "has a pressure of
/// 1.5: expected 0 to 1"; empty if it can.
std::string sample_fault(const TimedPoint& point, double last_time);

}  // namespace calligraphy
