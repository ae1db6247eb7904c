#include <calligraphy/practice/lesson_options.hpp>

#include <cmath>

#include "base/enum_name.hpp"
#include "base/require.hpp"

namespace calligraphy {
namespace {

constexpr double most_strength = 0.95;     // beyond it no device is stiff enough
constexpr double longest_hint_time = 10.0;  // [s]
constexpr double longest_absence = 60.0;   // for which memory is set aside [s]
constexpr double most_misses = 1e6;

}  // namespace

const char* to_string(LessonMode mode) noexcept {
  static constexpr const char* names[] = {"guided", "vision", "next stroke", "memory", "watch"};
  return name_of<LessonMode::watch>(mode, names, "");
}

void validate(const LessonOptions& options) {
  if (!std::isnan(options.strength)) require_within("strength", options.strength, "", 0.0, most_strength);
  require_within("misses_until_shown", options.misses_until_shown, "", 0.0, most_misses);
  require_within("hint_time", options.hint_time, "s", 0.0, longest_hint_time);
  require_within("max_absence", options.max_absence, "s", 1e-3, longest_absence);
}

}  // namespace calligraphy
