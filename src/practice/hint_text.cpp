#include <calligraphy/practice/hint_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string_view>

namespace calligraphy {

std::string way_text(const Point& way, const Language& language) {
  constexpr std::array<std::string_view, 8> keys = {
      "towards.right", "towards.top_right",   "towards.top",    "towards.top_left",
      "towards.left",  "towards.bottom_left", "towards.bottom", "towards.bottom_right"};
  const double eighths = std::atan2(way.y(), way.x()) / (0.25 * std::numbers::pi);
  const auto direction = static_cast<std::size_t>(std::lround(eighths) + 8) % keys.size();
  const long millimetres = std::max(1L, std::lround(std::min(1000.0 * way.norm(), 1e9)));
  return language.text(keys[direction], {{"distance", std::to_string(millimetres)}});
}

std::string hint_text(WritingHint hint, const Point& to_start, const Language& language) {
  const std::string key = std::string("hint.") + to_string(hint);
  const std::string with_way =
      to_start.allFinite() ? language.text(key + ".way", {{"way", way_text(to_start, language)}}) : "";
  return with_way.empty() ? language.text(key) : with_way;
}

}  // namespace calligraphy
