// Timing report of a servo loop, as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/devices/servo_statistics.hpp>

namespace calligraphy::tools {

/// Percentiles of period and work time, missed deadlines, and every fault by name.
std::string lines(const ServoStatistics& statistics);

/// A list with one object per run.
std::string json(const std::vector<ServoStatistics>& runs);

}  // namespace calligraphy::tools
