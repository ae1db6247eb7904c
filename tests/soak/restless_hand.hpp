// A hand that writes a page for days: well, badly, off the stroke, backwards, or not at all.
#pragma once

#include <array>
#include <vector>

#include <calligraphy/devices/device_state.hpp>
#include <calligraphy/devices/simulated_device.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

#include "hard_cases.hpp"

namespace calligraphy_test {

/// Moves to the start of the next stroke, lowers the pen, follows the stroke with an error, raises the pen, and
/// repeats. Allocates only when constructed.
class RestlessHand {
 public:
  RestlessHand(const calligraphy::HapticRenderer& renderer, std::uint64_t seed);

  /// Intended motion of the pen over the next `seconds`, in device axes.
  calligraphy::Intention next(const calligraphy::HapticTick& tick, double seconds);

  const Eigen::Vector3d& place() const { return place_; }  ///< page [m]

 private:
  enum class Phase { approach, lower, write, raise, rest };
  struct Drawn {
    calligraphy::Point origin;
    std::vector<std::vector<calligraphy::Point>> strokes;  ///< points 0.5 mm apart [m]
  };

  void choose(const calligraphy::HapticTick& tick);
  calligraphy::Point on_stroke(double way) const;
  Eigen::Vector3d goal() const;

  const calligraphy::HapticRenderer& renderer_;
  Sequence random_;
  std::vector<Drawn> drawn_;  ///< of the page's first characters, which repeat
  Phase phase_ = Phase::rest;
  double left_ = 0.1;  ///< remaining time of a rest [s]
  const std::vector<calligraphy::Point>* path_ = nullptr;
  calligraphy::Point error_ = {0.0, 0.0};     ///< of the whole stroke [m]
  double way_ = 0.0, end_ = 0.0;              ///< position on the stroke, in points
  double speed_ = 0.06;                       ///< [m/s]
  double depth_ = 0.001;                      ///< depth in the paper [m]
  Eigen::Vector3d place_ = {0.0, 0.0, 0.02};  ///< page [m]
};

/// Number of different characters on a soak page before they repeat.
inline constexpr int soak_characters = 12;

/// `count` characters of the built-in set, on top of one another in a row of three squares.
std::vector<calligraphy::PlacedCharacter> soak_page(int count);

}  // namespace calligraphy_test
