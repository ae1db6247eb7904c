// The quantities of a StylusState, for formats and checks: one table of their names and domains.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

#include <calligraphy/base/stylus_state.hpp>

namespace calligraphy {

struct StylusField {
  std::string_view name;
  double StylusState::*member;
  double least, most;
};

/// Wide enough for every pen: a value beyond them is a mistake of units.
inline constexpr std::array<StylusField, 6> stylus_fields = {{
    {"pressure", &StylusState::pressure, 0.0, 1.0},
    {"force", &StylusState::force, 0.0, 1e3},
    {"altitude", &StylusState::altitude, -std::numbers::pi / 2.0, std::numbers::pi / 2.0},
    {"azimuth", &StylusState::azimuth, -2.0 * std::numbers::pi, 2.0 * std::numbers::pi},
    {"twist", &StylusState::twist, -2.0 * std::numbers::pi, 2.0 * std::numbers::pi},
    {"height", &StylusState::height, -10.0, 10.0},
}};

/// Whether a quantity is in its domain, or not sensed.
inline bool is_valid(const StylusField& field, double value) noexcept {
  return std::isnan(value) || (value >= field.least && value <= field.most);
}

}  // namespace calligraphy
