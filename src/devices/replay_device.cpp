#include <cmath>
#include <limits>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/replay_device.hpp>
#include <calligraphy/devices/velocity_estimator.hpp>

#include "base/require.hpp"

namespace calligraphy {
namespace {

/// Positions are not checked: a recorded fault must be replayed as it was.
std::vector<DeviceState> checked(std::vector<DeviceState> samples) {
  if (samples.empty()) throw ValueError("replay has no samples");
  double previous = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double time = samples[i].time;
    if (!(std::isfinite(time) && time > previous)) {
      Message message;
      message << "replay sample " << i << ": time is " << time << " s after " << previous
              << " s, must be finite and increasing";
      throw ValueError(message.str());
    }
    previous = time;
  }
  return samples;
}

/// Adds velocities that were not recorded, as a device that estimates them would have done. An infinite one is a
/// recorded fault.
std::vector<DeviceState> with_velocities(std::vector<DeviceState> samples, double cutoff) {
  VelocityEstimator estimator(cutoff);
  double last_time = 0.0;  // time of the last fresh sample [s]
  for (DeviceState& sample : samples) {
    const bool repeated = sample.status == DeviceStatus::stale;
    const bool usable = sample.status == DeviceStatus::ok || sample.status == DeviceStatus::warm_motors;
    if (usable) estimator.update(sample.position, sample.time - std::exchange(last_time, sample.time));
    if (!usable && !repeated) estimator.restart();
    if (!sample.velocity.array().isNaN().any() || sample.velocity.array().isInf().any()) continue;
    sample.velocity = estimator.velocity();
    sample.velocity_estimated = true;
  }
  return samples;
}

}  // namespace

ReplayDevice::ReplayDevice(std::vector<DeviceState> samples, Capabilities capabilities)
    : samples_(with_velocities(checked(std::move(samples)), capabilities.velocity_cutoff)),
      capabilities_(std::move(capabilities)) {}

DeviceState ReplayDevice::read() noexcept {
  if (!finished()) return samples_[next_++];
  DeviceState state = samples_[next_ == 0 ? 0 : next_ - 1];
  state.status = DeviceStatus::disconnected;
  return state;
}

void ReplayDevice::write(const Eigen::Vector3d& force) noexcept {
  if (!open_) return;
  force_ = force;
  if (!force_.allFinite()) force_.setZero();
}

void ReplayDevice::close() noexcept {
  open_ = false;
  force_.setZero();
}

}  // namespace calligraphy
