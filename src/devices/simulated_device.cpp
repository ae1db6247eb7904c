#include <cmath>
#include <limits>
#include <sstream>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/simulated_device.hpp>

#include "axis_motion.hpp"

namespace calligraphy {
namespace {

constexpr int longest_delay = 100'000;  // 100 s at 1 kHz; more is a mistake and would only take memory

[[noreturn]] void refuse(const std::string& name, double value, const char* domain) {
  std::ostringstream message;
  message << name << " is " << value << ", must be " << domain;
  throw ValueError(message.str());
}

void require_not_negative(const std::string& name, double value) {
  if (!(std::isfinite(value) && value >= 0.0)) refuse(name, value, "finite and at least 0");
}

const Capabilities& checked(const Capabilities& device) {
  validate(device);
  require_translations(device, "the simulation");
  const std::string of_device = "device \"" + device_label(device) + "\": ";
  if (!(device.apparent_mass > 0.0)) {
    refuse(of_device + "apparent mass", device.apparent_mass, "above 0: a mass that is not known cannot be simulated");
  }
  if (device.sample_delay > longest_delay) {
    refuse(of_device + "sample delay", device.sample_delay, "from 0 to 100000 ticks");
  }
  if (!(device.peak_force > 0.0)) refuse(of_device + "peak force", device.peak_force, "above 0");
  return device;
}

const Hand& checked(const Hand& hand) {
  require_not_negative("mass of the hand", hand.mass);
  require_not_negative("damping of the hand", hand.damping);
  require_not_negative("stiffness of the hand", hand.stiffness);
  return hand;
}

const Eigen::Vector3d& checked(const Eigen::Vector3d& position) {
  for (const double coordinate : position) {
    if (!std::isfinite(coordinate)) refuse("coordinate of the device's position", coordinate, "finite");
  }
  return position;
}

/// Scaled by its largest component first, so that no square overflows.
Eigen::Vector3d shortened(const Eigen::Vector3d& force, double limit) noexcept {
  const double largest = force.cwiseAbs().maxCoeff();
  if (largest == 0.0) return force;
  const Eigen::Vector3d scaled = force / largest;
  const double length = scaled.norm();
  if (largest * length <= limit) return force;
  return scaled * (limit / length);
}

}  // namespace

SimulatedDevice::SimulatedDevice(const Capabilities& device, const Hand& hand, const Eigen::Vector3d& position)
    : device_(checked(device)), hand_(checked(hand)), position_(checked(position)) {
  intention_.position = position;  // a hand that is told nothing holds still
  samples_.assign(static_cast<std::size_t>(device_.sample_delay) + 1, sample());
}

DeviceState SimulatedDevice::read() noexcept {
  // The slot behind the newest is the oldest; at the start every slot holds the first sample.
  DeviceState state = samples_[(newest_ + 1) % samples_.size()];
  if (!open_) state.status = DeviceStatus::disconnected;
  return state;
}

void SimulatedDevice::write(const Eigen::Vector3d& force) noexcept {
  if (!open_) return;
  force_.setZero();
  if (force.allFinite()) force_ = shortened(force, device_.peak_force);
}

void SimulatedDevice::close() noexcept {
  open_ = false;
  force_.setZero();
}

void SimulatedDevice::set_hand(const Hand& hand) { hand_ = checked(hand); }

void SimulatedDevice::set_intention(const Intention& intention) noexcept {
  if (intention.position.allFinite() && intention.velocity.allFinite()) intention_ = intention;
}

void SimulatedDevice::advance(double seconds) noexcept {
  if (!(std::isfinite(seconds) && seconds > 0.0)) return;
  const Oscillator oscillator(device_.apparent_mass + hand_.mass, device_.viscous_friction + hand_.damping,
                              hand_.stiffness);
  const ImpulseResponse whole_step = oscillator.impulse_response(seconds);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    AxisLoad load;
    load.force = force_[axis] + hand_.damping * intention_.velocity[axis];
    load.target = intention_.position[axis];
    load.target_velocity = intention_.velocity[axis];
    load.dry_friction = device_.coulomb_friction;
    const AxisState state = move_axis(oscillator, whole_step, {position_[axis], velocity_[axis]}, load, seconds);
    // Only figures near the largest double come here unrepresentable; the axis then stays where it was, at rest.
    const bool representable = std::isfinite(state.position) && std::isfinite(state.velocity);
    if (representable) position_[axis] = state.position;
    velocity_[axis] = representable ? state.velocity : 0.0;
  }
  // Two advances without a new intention continue one line: the answer is that of a single longer one.
  intention_.position += intention_.velocity * seconds;
  time_ += seconds;
  newest_ = (newest_ + 1) % samples_.size();
  samples_[newest_] = sample();
}

DeviceState SimulatedDevice::sample() const noexcept {
  DeviceState state;
  state.time = time_;
  state.position = position_;
  if (device_.encoder_step > 0.0) {
    for (double& coordinate : state.position) {
      coordinate = std::round(coordinate / device_.encoder_step) * device_.encoder_step;
    }
  }
  state.velocity = velocity_;
  state.buttons = buttons_;
  return state;
}

}  // namespace calligraphy
