// The fraction of the peak force that the motors may exert while the vendor's runtime reports that they are warm.
#pragma once

#include <algorithm>
#include <cmath>

namespace calligraphy::hdapi {

/// The vendor's examples switch the force off while the runtime reports warm motors, and lower it from a temperature of
/// 0.7 on until 0.5, on a scale where the motors must not reach 1. Here the permitted force is the peak up to 0.7 and
/// falls linearly to zero at 1; while warm motors are reported it is zero. The limit moves there slowly, except at 1,
/// since guidance that gives way at once feels like a fault.
class HeatLimit {
 public:
  static constexpr double fall_time = 10.0;     ///< from the peak to none [s]
  static constexpr double rise_time = 30.0;     ///< from none to the peak [s]
  static constexpr double fall_at_limit = 0.1;  ///< fall_time from temperature 1 on [s]
  static constexpr double warm = 0.7, cool = 0.5;

  /// `reported`: warm motors; `temperature`: of the warmest motor, NaN if the runtime does not say [1]; `elapsed` since
  /// the last update [s].
  void update(bool reported, double temperature, double elapsed) noexcept {
    const double permitted = reported ? 0.0 : std::isnan(temperature) ? 1.0 : of(temperature);
    const double fall = std::min(elapsed, max_step) / (temperature >= 1.0 ? fall_at_limit : fall_time);
    share_ = std::clamp(permitted, share_ - fall, share_ + elapsed / rise_time);
    is_warm_ = share_ < 1.0 || (is_warm_ && temperature > cool);
  }

  /// Permitted fraction of the peak force.
  double share() const noexcept { return share_; }
  bool is_warm() const noexcept { return is_warm_; }

 private:
  /// Time that counts at most after a pause, in which the motors have cooled [s].
  static constexpr double max_step = 5e-3;

  static double of(double temperature) noexcept { return std::clamp((1.0 - temperature) / (1.0 - warm), 0.0, 1.0); }

  double share_ = 1.0;
  bool is_warm_ = false;
};

}  // namespace calligraphy::hdapi
