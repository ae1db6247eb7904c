#include "pens.hpp"

#include <algorithm>
#include <cmath>

#include "scene.hpp"

namespace calligraphy_test {

using namespace calligraphy;

Pen::Pen(const PracticePage& page, const Capabilities& device, const RendererOptions& options)
    : renderer_(page.characters, upright_page(page.width, page.height), device, options),
      period_(1.0 / options.servo_rate) {
  intended_.head<2>() = Point(0.5 * page.width, 0.5 * page.height);
}

void Pen::step_and_see(const Eigen::Vector3d& to) {
  step(to);
  intended_ = to;
  drawn_.started |= has_event(last().events, TickEvent::stroke_started);
  drawn_.finished |= has_event(last().events, TickEvent::stroke_finished);
}

void Pen::go(const Eigen::Vector3d& to, double seconds) {
  const Eigen::Vector3d from = intended_;
  const int ticks = std::max(1, static_cast<int>(std::lround(seconds / period_)));
  for (int i = 1; i <= ticks; ++i) {
    step_and_see(from + smooth_step(static_cast<double>(i) / ticks) * (to - from));
  }
}

Drawn Pen::draw(const StrokeLine& line, double em) {
  constexpr double shortest = 0.12;  // time for a hook or a dot [s]
  drawn_ = {};
  const auto raised_at = [](const Point& point, double height) {
    return Eigen::Vector3d(point.x(), point.y(), height);
  };
  go(raised_at(line.at(0.0), raised), 0.3);
  go(raised_at(line.at(0.0), -pressed_), 0.2);
  for (std::size_t i = 1; i < line.corners().size(); ++i) {
    const double from = line.corners()[i - 1], way = line.corners()[i] - from;
    const double seconds = std::max(shortest, way / (people_speed * em));
    const int ticks = static_cast<int>(std::lround(seconds / period_));
    for (int k = 1; k <= ticks; ++k) {
      step_and_see(raised_at(line.at(from + smooth_step(static_cast<double>(k) / ticks) * way), -pressed_));
    }
  }
  go(raised_at(intended_.head<2>(), raised), 0.12);
  go(intended_, 0.08);  // until a held pen is there
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
