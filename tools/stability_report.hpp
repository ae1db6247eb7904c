// What `calligraphy stability` found: as tables for a person, as JSON for a program.
#pragma once

#include <string>

#include <calligraphy/experiments/stability_map.hpp>

namespace calligraphy::tools {

std::string table(const SampledLoop& loop, const StiffnessAdvice& advice);
std::string json(const SampledLoop& loop, const StiffnessAdvice& advice);

/// A table per sweep, and one that sums up the grid.
std::string tables(const StabilityMap& map);
std::string json(const StabilityMap& map);

}  // namespace calligraphy::tools
