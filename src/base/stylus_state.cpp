#include <calligraphy/base/stylus_state.hpp>

#include <cmath>

namespace calligraphy {
namespace {

bool same(double a, double b) noexcept { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

bool StylusState::operator==(const StylusState& other) const noexcept {
  return same(pressure, other.pressure) && same(force, other.force) && same(altitude, other.altitude) &&
         same(azimuth, other.azimuth) && same(twist, other.twist) && same(height, other.height);
}

/// The barrel is where the two planes that the tilts turn about the axes meet.
void set_tilt(StylusState& stylus, double tilt_x, double tilt_y) noexcept {
  const double x = std::sin(tilt_x) * std::cos(tilt_y);
  const double y = std::sin(tilt_y) * std::cos(tilt_x) + 0.0;  // without the sign of a zero
  const double z = std::cos(tilt_x) * std::cos(tilt_y);
  stylus.azimuth = std::atan2(y, x);
  stylus.altitude = std::atan2(z, std::hypot(x, y));
}

}  // namespace calligraphy
