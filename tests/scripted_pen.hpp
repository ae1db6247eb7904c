// A pen that moves as a test prescribes, whatever the force: its samples go straight into a renderer, without device or
// hand.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include <calligraphy/devices/velocity_estimator.hpp>
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
      : renderer_(renderer), period_(1.0 / rate), velocity_(renderer.options().velocity_cutoff) {}

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
    sampled_ = state.position;
    const Eigen::Vector3d last = force_;
    const HapticTick& tick = renderer_.update(state);
    force_ = tick.force;
    const double step = (force_ - last).norm();
    max_step = std::max(max_step, step);
    max_unexplained = std::max(max_unexplained, step - explained_step(tick));
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

  double max_step = 0.0;  ///< maximum change of the force per tick [N]
  /// By how much that was beyond the rate limits and what springs and dampers change because the pen moves [N].
  double max_unexplained = -std::numeric_limits<double>::infinity();
  double max_force = 0.0;  ///< [N]
  bool finite = true;

 private:
  /// How far the force may change in this tick: K |dx| + B |dv| beyond the rate limits, in the paper plane and along
  /// its normal, for pens of up to 1 m/s that are kicked by up to 0.3 m/s [N, device]. What the pen did while no sample
  /// showed it explains nothing, because the force did not follow then.
  double explained_step(const HapticTick& tick) {
    const calligraphy::RendererOptions& options = renderer_.options();
    const double scale = renderer_.mapping().scale, period = 1.0 / options.servo_rate;
    Eigen::Vector3d way(0, 0, 0), kick(0, 0, 0);
    if (tick.status == calligraphy::TickStatus::ok) {
      const Eigen::Vector3d place = renderer_.mapping().to_page(sampled_), before = velocity_.velocity();
      velocity_.update(place, seen_ ? std::max(tick.time - seen_at_, period) : period);
      if (followed_) {
        way = place - seen_place_;
        kick = velocity_.velocity() - before;
      }
      seen_ = true;
      seen_at_ = tick.time;
      seen_place_ = place;
    }
    followed_ = tick.status == calligraphy::TickStatus::ok;
    const auto capped = [](double value, double most) { return std::min(std::abs(value), most); };
    double attraction = 1.0;
    for (const calligraphy::PlacedCharacter& placed : renderer_.page()) {
      const auto& factors = placed.character.physics.attraction_factors;
      attraction = std::max(attraction, *std::max_element(factors.begin(), factors.end()));
    }
    const bool rubs = options.paper.friction.coefficient > 0.0;
    const double spring = options.guidance.stiffness * attraction + options.guidance.wrong_way_stiffness +
                          (rubs ? options.paper.friction.stiffness : 0.0);
    const double damper = options.guidance.damping + (rubs ? options.paper.friction.damping : 0.0);
    const double furthest = 1.0 * scale * period, hardest = 0.3 * scale;
    const double in_plane =
        spring * capped(way.head<2>().norm(), furthest) + damper * capped(kick.head<2>().norm(), hardest);
    const double down = std::abs(way.z());
    const double entered = down < options.paper.onset ? down / options.paper.onset : 1.0;
    const double shoved = std::abs(kick.z()) + entered * std::abs(velocity_.velocity().z());
    const double normal =
        options.paper.stiffness * capped(down, furthest) + options.paper.damping * capped(shoved, hardest);
    // Without a limit on the rate, steps are compared with the default's.
    const calligraphy::ForceLimits usual;
    const bool is_limited = std::isfinite(options.limits.in_plane_rate);
    const double steps_in_plane = is_limited ? options.limits.in_plane_rate : usual.in_plane_rate;
    const double steps_normal = is_limited ? options.limits.normal_rate : usual.normal_rate;
    return std::hypot(steps_in_plane * period + scale * in_plane, steps_normal * period + scale * normal);
  }

  calligraphy::HapticRenderer& renderer_;
  double period_;
  calligraphy::VelocityEstimator velocity_;
  Eigen::Vector3d sampled_ = Eigen::Vector3d::Zero();  ///< position of this sample, as the device returns it
  bool seen_ = false;
  bool followed_ = false;  ///< the last sample was good
  double seen_at_ = 0.0;
  Eigen::Vector3d seen_place_ = Eigen::Vector3d::Zero();
  double time_ = 0.0;
  bool started_ = false;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
};

}  // namespace calligraphy_test
