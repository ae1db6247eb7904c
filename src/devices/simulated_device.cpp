#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <calligraphy/devices/simulated_device.hpp>

#include "axis_motion.hpp"
#include "base/require.hpp"

namespace calligraphy {
namespace {

constexpr int max_delay = 100'000;  // 100 s at 1 kHz; more is a mistake and would only use memory
constexpr int max_late = 1000;      // beyond the delay
constexpr double same_time = 1e-9;  // sums of ticks come this close to the times of a schedule [s]

const Capabilities& checked(const Capabilities& device) {
  validate(device);
  require_translations(device, "the simulation");
  const std::string of_device = "device \"" + device_label(device) + "\": ";
  require(device.apparent_mass > 0.0, of_device + "apparent mass", device.apparent_mass, "kg",
          "above 0: a device of unknown mass cannot be simulated");
  require_within(of_device + "sample delay", device.sample_delay, "ticks", 0, max_delay);
  require(device.peak_force > 0.0, of_device + "peak force", device.peak_force, "N", "above 0");
  return device;
}

const GripImpedance& checked(const GripImpedance& grip) {
  require_not_negative("mass of the grip", grip.mass, "kg");
  require_not_negative("damping of the grip", grip.damping, "N s/m");
  require_not_negative("stiffness of the grip", grip.stiffness, "N/m");
  return grip;
}

const Eigen::Vector3d& checked(const Eigen::Vector3d& position) {
  for (const double coordinate : position) {
    require(std::isfinite(coordinate), "coordinate of the device's position", coordinate, "m", "finite");
  }
  return position;
}

const std::vector<SimulatedFault>& checked(const std::vector<SimulatedFault>& faults) {
  for (std::size_t i = 0; i < faults.size(); ++i) {
    const std::string of_fault = "scheduled fault " + std::to_string(i) + ": ";
    require(std::isfinite(faults[i].begin), of_fault + "begin", faults[i].begin, "s", "finite");
    require(faults[i].duration > 0.0, of_fault + "duration", faults[i].duration, "s", "above 0");
    require_within(of_fault + "ticks", faults[i].ticks, "", 1, max_late);
  }
  return faults;
}

constexpr SimulatedFault no_fault = {.kind = SimulatedFaultKind::reported, .status = DeviceStatus::ok};

void apply(const SimulatedFault& fault, DeviceState& state) noexcept {
  switch (fault.kind) {
    case SimulatedFaultKind::stale:
      state.status = DeviceStatus::stale;
      state.fault = fault.fault;
      break;
    case SimulatedFaultKind::late:
      break;  // the choice of the sample makes it late
    case SimulatedFaultKind::garbage:
      state.position.setConstant(std::numeric_limits<double>::quiet_NaN());
      state.velocity.setConstant(std::numeric_limits<double>::quiet_NaN());
      break;
    case SimulatedFaultKind::unplugged:
      state.status = DeviceStatus::disconnected;
      state.fault = DeviceFault::unplugged;
      break;
    case SimulatedFaultKind::reported:
      state.status = fault.status;
      state.fault = fault.fault;
      break;
  }
}

}  // namespace

SimulatedDevice::SimulatedDevice(const Capabilities& device, const GripImpedance& grip, const Eigen::Vector3d& position)
    : device_(checked(device)), grip_(checked(grip)), position_(checked(position)), estimator_(device.velocity_cutoff) {
  device_.simulated = true;
  intention_.position = position;  // by default the hand holds still
  samples_.assign(static_cast<std::size_t>(device_.sample_delay) + 1, sample(0.0));
  last_read_ = samples_.front();
}

void SimulatedDevice::schedule(std::vector<SimulatedFault> faults) {
  std::size_t latest = 0;
  for (const SimulatedFault& fault : checked(faults)) {
    if (fault.kind == SimulatedFaultKind::late) latest = std::max(latest, static_cast<std::size_t>(fault.ticks));
  }
  const std::size_t needed = static_cast<std::size_t>(device_.sample_delay) + latest + 1;
  if (needed > samples_.size()) {
    // Sorts by age and repeats the oldest in front, as if the device had been at rest before.
    std::rotate(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(newest_ + 1), samples_.end());
    samples_.insert(samples_.begin(), needed - samples_.size(), DeviceState(samples_.front()));
    newest_ = samples_.size() - 1;
  }
  faults_ = std::move(faults);
  if (unplugged()) force_.setZero();
}

const SimulatedFault& SimulatedDevice::current_fault() const noexcept {
  for (const SimulatedFault& fault : faults_) {
    const double since = time_ - fault.begin;
    if (since > -same_time && since < fault.duration - same_time) return fault;
  }
  return no_fault;
}

bool SimulatedDevice::unplugged() const noexcept { return current_fault().kind == SimulatedFaultKind::unplugged; }

DeviceState SimulatedDevice::read() noexcept {
  const SimulatedFault& fault = current_fault();
  if (fault.kind != SimulatedFaultKind::stale && fault.kind != SimulatedFaultKind::unplugged) {
    const int age = device_.sample_delay + (fault.kind == SimulatedFaultKind::late ? fault.ticks : 0);
    last_read_ = samples_[(newest_ + samples_.size() - static_cast<std::size_t>(age)) % samples_.size()];
  }
  DeviceState state = last_read_;
  state.force = force_;
  apply(fault, state);
  if (!open_) state.status = DeviceStatus::disconnected;
  return state;
}

void SimulatedDevice::write(const Eigen::Vector3d& force) noexcept {
  if (!force.allFinite()) ++refused_forces_;
  if (open_ && !unplugged()) force_ = output_force(device_, force);
}

void SimulatedDevice::close() noexcept {
  open_ = false;
  force_.setZero();
}

void SimulatedDevice::set_grip(const GripImpedance& grip) { grip_ = checked(grip); }

void SimulatedDevice::set_intention(const Intention& intention) noexcept {
  if (intention.position.allFinite() && intention.velocity.allFinite()) intention_ = intention;
}

void SimulatedDevice::advance(double seconds) {
  require_not_negative("advance: seconds", seconds, "s");
  if (seconds == 0.0) return;
  const Oscillator oscillator(device_.apparent_mass + grip_.mass, device_.viscous_friction + grip_.damping,
                              grip_.stiffness);
  const ImpulseResponse whole_step = oscillator.impulse_response(seconds);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    AxisLoad load;
    load.force = force_[axis] + grip_.damping * intention_.velocity[axis];
    load.target = intention_.position[axis];
    load.target_velocity = intention_.velocity[axis];
    load.dry_friction = device_.coulomb_friction;
    const AxisState state = advance_axis(oscillator, whole_step, {position_[axis], velocity_[axis]}, load, seconds);
    // Values near the largest double may overflow; the axis then stays where it was, at rest.
    const bool representable = std::isfinite(state.position) && std::isfinite(state.velocity);
    if (representable) position_[axis] = state.position;
    velocity_[axis] = representable ? state.velocity : 0.0;
  }
  // Two advances without a new intention continue one line, so the result equals that of a single longer advance.
  intention_.position += intention_.velocity * seconds;
  time_ += seconds;
  newest_ = (newest_ + 1) % samples_.size();
  samples_[newest_] = sample(seconds);
  if (unplugged()) force_.setZero();
}

/// `elapsed`: since the previous sample [s].
DeviceState SimulatedDevice::sample(double elapsed) noexcept {
  DeviceState state;
  state.time = time_;
  state.position = position_;
  if (device_.encoder_step > 0.0) {
    for (double& coordinate : state.position) {
      coordinate = std::round(coordinate / device_.encoder_step) * device_.encoder_step;
    }
  }
  state.velocity_estimated = device_.velocity == VelocitySource::estimated;
  state.velocity = state.velocity_estimated ? estimator_.update(state.position, elapsed) : velocity_;
  state.buttons = buttons_;
  state.stylus = intention_.stylus;
  return state;
}

}  // namespace calligraphy
