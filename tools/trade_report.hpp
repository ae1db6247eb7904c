// What `calligraphy trade` measured: as tables for a person, as JSON for a program.
#pragma once

#include <string>
#include <vector>

#include <calligraphy/experiments/trade.hpp>

namespace calligraphy::tools {

struct TradeReport {
  std::u32string text;     ///< the characters it was measured on
  std::u32string written;  ///< those of them that were written at every servo rate
  std::uint64_t seed = 1;
  NearestPointTradeOptions nearest_options;
  ServoRateTradeOptions servo_options;
  std::vector<NearestPointTrade> nearest_point;
  std::vector<ServoRateTrade> servo_rate;
  std::vector<CoordinateWidthTrade> coordinate_width;
};

std::string tables(const TradeReport& report);

/// An object with a list per trade.
std::string json(const TradeReport& report);

}  // namespace calligraphy::tools
