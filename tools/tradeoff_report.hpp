// Report of `calligraphy tradeoff`, as tables and as JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <calligraphy/experiments/tradeoff.hpp>
#include <calligraphy/importers/character_import.hpp>

namespace calligraphy::tools {

struct TradeoffReport {
  std::u32string text;     ///< measured characters
  std::u32string written;  ///< those of them written at every servo rate
  std::uint64_t seed = 1;
  NearestPointTradeoffOptions nearest_options;
  ServoRateTradeoffOptions servo_options;
  std::vector<NearestPointTradeoff> nearest_point;
  std::vector<ServoRateTradeoff> servo_rate;
  std::vector<CoordinateWidthTradeoff> coordinate_width;
  std::optional<ImportResult> ink;  ///< the characters, imported with a report, if a source of ink is given
};

std::string tables(const TradeoffReport& report);

/// An object with one list per tradeoff.
nlohmann::ordered_json json(const TradeoffReport& report);

}  // namespace calligraphy::tools
