// A simulated pen and the hand that holds it, written independently of the library's own simulation so that it can
// judge the library: a point mass integrated at 20 us, and the energy that its force has given to the hand.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <calligraphy/devices/haptic_device.hpp>

namespace calligraphy_test {

using calligraphy::Capabilities;
using calligraphy::DeviceState;
using calligraphy::DeviceStatus;
using calligraphy::GripImpedance;
using Eigen::Vector3d;

/// What a hand does at one instant.
struct HandAction {
  Vector3d force = Vector3d::Zero();  ///< of the hand on the pen, device axes [N]
  double mass = 0.0;                  ///< that moves with the pen [kg]
};

/// Force of a grip: spring and damper towards an intended position that moves [N].
inline Vector3d grip_force(const GripImpedance& grip, const Vector3d& to, const Vector3d& velocity_to,
                           const Vector3d& position, const Vector3d& velocity) {
  return grip.stiffness * (to - position) + grip.damping * (velocity_to - velocity);
}

/// How the device states the pen's velocity.
enum class VelocityGiven {
  truth,
  estimated,  ///< backward difference of encoder positions through a first-order low-pass at 50 Hz
  unknown     ///< NaN
};

/// The resolution of the force, where the capabilities state one [N].
template <typename AnyCapabilities>
double force_step_of(const AnyCapabilities& device) {
  if constexpr (requires { device.force_step; }) {
    return device.force_step;
  } else {
    return 0.0;
  }
}

/// A point mass with the device's mass, viscous friction, and Coulomb friction along each device axis, which holds up
/// to its full value at rest. Each step is exact under the held force, takes the hand's force at its midpoint (a spring
/// neither gains nor loses energy), and never passes through a stop: the axis breaks away in the next one.
///
/// A fresh sample is taken at the end of each advance(), rounded to the encoder step; read() returns the one of
/// `sample_delay` samples ago. The device does not report the force at work.
class IndependentDevice final : public calligraphy::HapticDevice {
 public:
  static constexpr double longest_step = 20e-6;  ///< [s]

  IndependentDevice(const Capabilities& device, const Vector3d& position,
                    VelocityGiven velocity_given = VelocityGiven::truth)
      : device_(device), velocity_given_(velocity_given), position_(position) {
    samples_.assign(static_cast<std::size_t>(device.sample_delay) + 1, sample());
  }

  const Capabilities& capabilities() const noexcept override { return device_; }

  DeviceState read() noexcept override {
    DeviceState state = samples_[(newest_ + 1) % samples_.size()];  // the oldest
    if (lost) state.position.setConstant(std::numeric_limits<double>::quiet_NaN());
    if (stale) {
      state = last_read_;
      state.status = DeviceStatus::stale;
    } else if (!lost) {
      last_read_ = state;
    }
    return state;
  }

  void write(const Vector3d& force) noexcept override {
    force_ = force.allFinite() ? force : Vector3d(0.0, 0.0, 0.0);
    const double size = force_.norm(), peak = device_.peak_force;
    if (peak > 0.0 && size > peak) force_ *= peak / size;
    const double step = force_step_of(device_);
    if (step > 0.0) force_ = (force_ / step).array().round().matrix() * step;
  }

  void close() noexcept override { force_.setZero(); }

  /// Moves on by `seconds` under the force last written and takes a sample. `hand(time, position, velocity)` returns
  /// the HandAction in device axes.
  template <typename Hand>
  void advance(double seconds, Hand&& hand) {
    const int steps = std::max(1, static_cast<int>(std::ceil(seconds / longest_step * (1.0 - 1e-9))));
    const double step = seconds / steps;
    for (int i = 0; i < steps; ++i) {
      move(hand(time_ + 0.5 * step, position_ + 0.5 * step * velocity_, velocity_), step);
      time_ += step;
    }
    newest_ = (newest_ + 1) % samples_.size();
    samples_[newest_] = sample(seconds);
  }

  // Faults of the next read(), until changed.
  bool stale = false;  ///< the sample of the last read again, and known to be so
  bool lost = false;   ///< a sample without a position

  double time() const { return time_; }
  const Vector3d& position() const { return position_; }  ///< true [m]
  const Vector3d& velocity() const { return velocity_; }  ///< true [m/s]
  const Vector3d& force() const { return force_; }        ///< at work [N]

  /// Net work of the force at work on the pen, that is, of the device on the hand and on friction [J].
  double energy_given() const { return energy_given_; }
  double most_energy_given() const { return most_energy_given_; }  ///< its maximum over time
  /// Integral of |F| |v| dt: an upper bound of what the force could have given [J].
  double energy_possible() const { return energy_possible_; }

 private:
  void move(const HandAction& hand, double step) {
    const double mass = device_.apparent_mass + hand.mass;
    const double holding = device_.coulomb_friction;
    double work = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double force = force_[i] + hand.force[i] - device_.viscous_friction * velocity_[i];
      const double old = velocity_[i];
      double speed = 0.0;
      if (old == 0.0) {
        if (std::abs(force) > holding) speed = (force - std::copysign(holding, force)) * step / mass;
      } else {
        speed = old + (force - std::copysign(holding, old)) * step / mass;
        if (holding > 0.0 && speed * old < 0.0) speed = 0.0;
      }
      velocity_[i] = speed;
      const double way = 0.5 * (old + speed) * step;
      position_[i] += way;
      work += force_[i] * way;
    }
    energy_given_ += work;
    most_energy_given_ = std::max(most_energy_given_, energy_given_);
    energy_possible_ += force_.norm() * velocity_.norm() * step;
  }

  DeviceState sample(double elapsed = 0.0) {
    DeviceState state;
    state.time = time_;
    state.position = position_;
    if (device_.encoder_step > 0.0) {
      state.position = (position_ / device_.encoder_step).array().round().matrix() * device_.encoder_step;
    }
    if (velocity_given_ == VelocityGiven::truth) {
      state.velocity = velocity_;
    } else if (velocity_given_ == VelocityGiven::estimated) {
      constexpr double cutoff = 2.0 * 3.141592653589793 * 50.0;  // [rad/s]
      if (elapsed > 0.0) {
        const Vector3d difference = (state.position - encoded_) / elapsed;
        estimate_ += (1.0 - std::exp(-cutoff * elapsed)) * (difference - estimate_);
      }
      encoded_ = state.position;
      state.velocity = estimate_;
    } else {
      state.velocity.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    return state;
  }

  Capabilities device_;
  VelocityGiven velocity_given_;
  double time_ = 0.0;
  Vector3d position_;
  Vector3d velocity_ = Vector3d::Zero();
  Vector3d force_ = Vector3d::Zero();
  double energy_given_ = 0.0, most_energy_given_ = 0.0, energy_possible_ = 0.0;
  Vector3d encoded_ = Vector3d::Zero(), estimate_ = Vector3d::Zero();
  std::vector<DeviceState> samples_;  ///< ring buffer
  std::size_t newest_ = 0;
  DeviceState last_read_;
};

}  // namespace calligraphy_test
