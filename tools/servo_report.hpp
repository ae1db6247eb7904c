// How a servo loop kept its time: as lines for a person, as JSON for a program.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/devices/servo_statistics.hpp>

namespace calligraphy::tools {

/// Periods and work in percentiles, what was missed, and every fault by name.
std::string lines(const ServoStatistics& statistics);

/// A list with an object per run.
std::string json(const std::vector<ServoStatistics>& runs);

}  // namespace calligraphy::tools
