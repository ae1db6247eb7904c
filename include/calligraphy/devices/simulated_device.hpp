// A simulated device and the hand that holds it, integrated exactly between samples.
#pragma once

#include <vector>

#include <calligraphy/devices/haptic_device.hpp>
#include <calligraphy/devices/velocity_estimator.hpp>

namespace calligraphy {

/// Intended position and velocity of the pen, in device axes.
struct Intention {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
};

/// A point mass held by a hand, in virtual time. During advance() the commanded force is held and the intended position
/// moves at constant velocity, so the motion along each axis is solved in closed form, including stops and breakaway
/// under Coulomb friction: the result does not depend on the step size.
class SimulatedDevice final : public HapticDevice {
 public:
  /// @throws ValueError naming the value when the device or the grip is not physical, when the apparent mass is
  /// unknown, or when a translation is not sensed or not driven
  explicit SimulatedDevice(const Capabilities& device, const GripImpedance& grip = {0.0, 0.0, 0.0},
                           const Eigen::Vector3d& position = Eigen::Vector3d::Zero());

  const Capabilities& capabilities() const noexcept override { return device_; }
  /// The sample taken `sample_delay` ticks ago. Its velocity is had as the device has it: the true one at that time, or
  /// estimated from the quantised positions of the samples, one per advance(). Its force is the one applied now.
  DeviceState read() noexcept override;
  /// Applies the device's output_force() for this one.
  void write(const Eigen::Vector3d& force) noexcept override;
  void close() noexcept override;

  /// Sets the intended position, initially the start position. It moves on at its velocity with every advance(). Values
  /// that are not finite are ignored.
  void set_intention(const Intention& intention) noexcept;
  /// @throws ValueError naming the value when the grip is not physical
  void set_grip(const GripImpedance& grip);
  /// Takes effect with the next advance().
  void set_buttons(std::uint32_t buttons) noexcept { buttons_ = buttons; }

  /// Advances virtual time by `seconds` and takes a sample. Does nothing unless `seconds` is finite and above 0. One
  /// call follows at most 256 stops along an axis; then the axis stays at rest until its end.
  void advance(double seconds) noexcept;

  /// The unquantised motion and the force applied.
  const Eigen::Vector3d& true_position() const noexcept { return position_; }
  const Eigen::Vector3d& true_velocity() const noexcept { return velocity_; }
  const Eigen::Vector3d& applied_force() const noexcept { return force_; }
  double time() const noexcept { return time_; }

 private:
  DeviceState sample(double elapsed) noexcept;

  Capabilities device_;
  GripImpedance grip_;
  Intention intention_;
  Eigen::Vector3d position_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
  VelocityEstimator estimator_;
  double time_ = 0.0;
  std::uint32_t buttons_ = 0;
  bool open_ = true;
  std::vector<DeviceState> samples_;  ///< ring buffer of the last sample_delay + 1 samples
  std::size_t newest_ = 0;
};

}  // namespace calligraphy
