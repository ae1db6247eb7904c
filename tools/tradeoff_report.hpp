// What `calligraphy tradeoff` measured: as tables for a person, as JSON for a program.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/experiments/tradeoff.hpp>

namespace calligraphy::tools {

struct TradeoffReport {
  std::u32string text;     ///< the characters it was measured on
  std::u32string written;  ///< those of them that were written at every servo rate
  std::uint64_t seed = 1;
  NearestPointTradeoffOptions nearest_options;
  ServoRateTradeoffOptions servo_options;
  std::vector<NearestPointTradeoff> nearest_point;
  std::vector<ServoRateTradeoff> servo_rate;
  std::vector<CoordinateWidthTradeoff> coordinate_width;
};

std::string tables(const TradeoffReport& report);

/// An object with a list per tradeoff.
std::string json(const TradeoffReport& report);

}  // namespace calligraphy::tools
