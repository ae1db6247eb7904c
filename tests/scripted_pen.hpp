// A pen that moves as a test prescribes, whatever the force: its samples go straight into a renderer, without device or
// hand.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <calligraphy/model/character_list.hpp>
#include <calligraphy/render/haptic_renderer.hpp>

#include "pen_path.hpp"

namespace calligraphy_test {

using calligraphy::HapticTick;

inline calligraphy::Capabilities test_device() {
  calligraphy::Capabilities device;
  device.model = "test device";
  device.simulated = true;
  device.peak_force = 3.3;
  device.usable_stiffness = 1000.0;
  return device;
}

inline calligraphy::PlacedCharacter placed(char32_t code, const Point& origin = {0.02, 0.02}, double em = 0.04) {
  return {*calligraphy::built_in_characters().find(code), {origin, em}};
}

/// On the page or above it [m].
inline Eigen::Vector3d at(const Point& point, double z) { return {point.x(), point.y(), z}; }

class ScriptedPen {
 public:
  explicit ScriptedPen(calligraphy::HapticRenderer& renderer, double rate = 1000.0)
      : renderer_(renderer), period_(1.0 / rate) {}

  std::function<void(const HapticTick&)> on_tick = [](const HapticTick&) {};
  double speed = 0.1;  ///< [m/s]

  /// One sample at a position on the page.
  const HapticTick& at(const Eigen::Vector3d& position) {
    calligraphy::DeviceState state;
    state.position = renderer_.mapping().to_device(position);
    return sample(state);
  }

  /// One sample as the device returns it; only its time is set by the pen.
  const HapticTick& sample(calligraphy::DeviceState state) {
    state.time = time_;
    time_ += period_;
    const Eigen::Vector3d last = force_;
    const HapticTick& tick = renderer_.update(state);
    force_ = tick.force;
    max_step = std::max(max_step, (force_ - last).norm());
    max_force = std::max(max_force, force_.norm());
    finite = finite && force_.allFinite();
    if (tick.status == calligraphy::TickStatus::ok) position_ = renderer_.mapping().to_page(state.position);
    on_tick(tick);
    return tick;
  }

  /// In a straight line at `speed`; the first call jumps there.
  void go(const Eigen::Vector3d& to) {
    const Eigen::Vector3d from = started_ ? position_ : to;
    started_ = true;
    const int count = std::max(1, static_cast<int>(std::ceil((to - from).norm() / (speed * period_))));
    for (int i = 1; i <= count; ++i) at(from + (to - from) * i / count);
  }

  /// Writes a path with the pen pressed in by `depth` [m]; begins and ends in the air.
  void write(const std::vector<Point>& path, double depth = 0.001) {
    go({path.front().x(), path.front().y(), 0.005});
    for (const Point& point : path) go({point.x(), point.y(), -depth});
    go({path.back().x(), path.back().y(), 0.005});
  }

  /// All strokes of a character, each with a lateral `offset` [m].
  void write(const calligraphy::PlacedCharacter& character, double offset = 0.0) {
    for (const Stroke& stroke : calligraphy::strokes(character.character)) {
      write(beside(path_of(stroke, character.placement, 0.0001), offset));
    }
  }

  double max_step = 0.0;   ///< maximum change of the force per tick [N]
  double max_force = 0.0;  ///< [N]
  bool finite = true;

 private:
  calligraphy::HapticRenderer& renderer_;
  double period_;
  double time_ = 0.0;
  bool started_ = false;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
};

}  // namespace calligraphy_test
