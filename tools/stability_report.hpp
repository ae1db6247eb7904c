// Report of `calligraphy stability`, as tables and as JSON.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include <calligraphy/experiments/stability_map.hpp>

namespace calligraphy::tools {

std::string table(const SampledLoop& loop, const StiffnessAdvice& advice);
std::string json(const SampledLoop& loop, const StiffnessAdvice& advice);

/// One table per sweep, and a summary of the grid.
std::string tables(const StabilityMap& map);
nlohmann::ordered_json json(const StabilityMap& map);

}  // namespace calligraphy::tools
