#include "pens.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "scene.hpp"

namespace calligraphy_test {

using namespace calligraphy;

namespace {

/// How far along the line a hand is after each tick.
std::vector<double> arcs_by_tick(const StrokeLine& line, double em, double period) {
  constexpr double shortest = 0.12;      // time for a hook or a dot [s]
  constexpr double reach = 0.02;         // over which the curvature is seen [em]
  constexpr double straightest = 0.5;    // a line is as fast as a bend of this curvature [1/em]
  constexpr double acceleration = 20.0;  // where it sets out and stops, in straight strokes' speeds [em/s^2]
  const double length = line.length();
  const int steps = std::max(16, static_cast<int>(std::ceil(length / (0.005 * em))));
  std::vector<double> times = {0.0};
  for (int i = 0; i < steps; ++i) {
    const double arc = length * (i + 0.5) / steps, near = std::min(arc, length - arc);
    const double around = std::min(reach * em, near);
    const Point before = line.at(arc) - line.at(arc - around), after = line.at(arc + around) - line.at(arc);
    const double turn = std::atan2(std::abs(before.x() * after.y() - before.y() * after.x()), before.dot(after));
    const double curvature = around > 0.0 ? turn * em / around : 0.0;
    const double speed = std::min(1.0 / std::cbrt(straightest + curvature), std::sqrt(2.0 * acceleration * near / em));
    times.push_back(times.back() + 1.0 / std::max(speed, 1e-6));  // a dot has no length
  }
  const int ticks = static_cast<int>(std::lround(std::max(shortest, length / (people_speed * em)) / period));
  std::vector<double> arcs;
  std::size_t step = 1;
  for (int k = 1; k <= ticks; ++k) {
    const double time = times.back() * k / ticks;
    while (step + 1 < times.size() && times[step] < time) ++step;
    const double share = std::min(1.0, (time - times[step - 1]) / (times[step] - times[step - 1]));
    arcs.push_back(length * (static_cast<double>(step - 1) + share) / steps);
  }
  return arcs;
}

}  // namespace

Pen::Pen(const PracticePage& page, const Capabilities& device, const RendererOptions& options)
    : renderer_(page.characters, upright_page(page.width, page.height), device, options),
      period_(1.0 / renderer_.options().servo_rate) {
  intended_.head<2>() = Point(0.5 * page.width, 0.5 * page.height);
  for (const PlacedCharacter& placed : page.characters) {
    stroke_counts_.push_back(static_cast<std::size_t>(placed.character.stroke_count()));
  }
}

std::size_t Pen::written() const {
  const auto character = static_cast<std::size_t>(last().character);
  const auto begin = stroke_counts_.begin(), end = begin + static_cast<std::ptrdiff_t>(character);
  const std::size_t before = std::accumulate(begin, end, std::size_t{0});
  return before + (character < stroke_counts_.size() ? static_cast<std::size_t>(last().stroke) : 0);
}

void Pen::step_and_see(const Eigen::Vector3d& to) {
  step(to);
  intended_ = to;
  if (on_tick) on_tick(last());
  const bool started = has_event(last().events, TickEvent::stroke_started);
  const bool finished = has_event(last().events, TickEvent::stroke_finished);
  drawn_.started |= started;
  drawn_.finished |= finished;
  drawn_.went_on |= started && finished;
}

void Pen::go(const Eigen::Vector3d& to, double seconds) {
  const Eigen::Vector3d from = intended_;
  const int ticks = std::max(1, static_cast<int>(std::lround(seconds / period_)));
  for (int i = 1; i <= ticks; ++i) {
    step_and_see(from + smooth_step(static_cast<double>(i) / ticks) * (to - from));
  }
}

Drawn Pen::draw(const StrokeLine& line, double em) {
  drawn_ = {};
  const auto raised_at = [](const Point& point, double height) {
    return Eigen::Vector3d(point.x(), point.y(), height);
  };
  go(raised_at(line.at(0.0), raised), 0.3);
  go(raised_at(line.at(0.0), -pressed_), 0.2);
  for (const double arc : arcs_by_tick(line, em, period_)) step_and_see(raised_at(line.at(arc), -pressed_));
  go(raised_at(intended_.head<2>(), raised), 0.12);
  go(intended_, 0.08);  // until a held pen is there
  return drawn_;
}

Drawn Pen::rest(double seconds) {
  drawn_ = {};
  go(intended_, seconds);
  return drawn_;
}

void KinematicPen::step(const Eigen::Vector3d& to) {
  time_ += period_;
  DeviceState state;
  state.time = time_;
  state.position = renderer_.mapping().to_device(to);
  renderer_.update(state);
}

HeldPen::HeldPen(const PracticePage& page, const Capabilities& device, const RendererOptions& options,
                 const GripImpedance& grip, Arm arm, bool feels)
    : Pen(page, device, options),
      device_(device, grip, renderer_.mapping().to_device(intended_)),
      grip_(grip),
      arm_(arm),
      feels_(feels),
      meant_(renderer_.mapping().to_device(intended_)) {
  pressed_ = 0.0025;
}

/// How far the hand means to be ahead, so that its spring exerts what moves the pen.
Eigen::Vector3d HeldPen::lead(const Eigen::Vector3d& velocity, const Eigen::Vector3d& acceleration) const {
  if (arm_ == Arm::naive) return Eigen::Vector3d::Zero();
  constexpr double slow = 0.002;  // friction sets in over this speed [m/s]
  const Capabilities& device = device_.capabilities();
  const Eigen::Vector3d friction = (velocity / slow).array().max(-1.0).min(1.0) * device.coulomb_friction;
  return ((device.apparent_mass + grip_.mass) * acceleration + device.viscous_friction * velocity + friction) /
         grip_.stiffness;
}

void HeldPen::step(const Eigen::Vector3d& to) {
  const MotionMapping& mapping = renderer_.mapping();
  const Eigen::Vector3d at = mapping.to_device(to);
  const Eigen::Vector3d velocity = (at - mapping.to_device(intended_)) / period_;
  const Eigen::Vector3d meant = at + lead(velocity, (velocity - velocity_) / period_);
  device_.set_intention({meant_, (meant - meant_) / period_});
  meant_ = meant;
  velocity_ = velocity;
  device_.advance(period_);
  const HapticTick& tick = renderer_.update(device_.read());
  device_.write(feels_ ? tick.force : Eigen::Vector3d(Eigen::Vector3d::Zero()));
}

}  // namespace calligraphy_test
