// A simulated device and the hand that holds it, integrated exactly between samples.
#pragma once

#include <cstdint>
#include <vector>

#include <calligraphy/devices/haptic_device.hpp>
#include <calligraphy/devices/simulated_fault.hpp>
#include <calligraphy/devices/velocity_estimator.hpp>

namespace calligraphy {

/// Intended motion of the pen, in device axes unless stated otherwise.
struct Intention {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< where the hand intends the pen to be [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< velocity of the intended position [m/s]
  StylusState stylus = {};                             ///< what the pen senses meanwhile; it does not move the device
};

/// A point mass held by a hand, in virtual time. During advance() the commanded force is held and the intended position
/// moves at constant velocity, so the motion along each axis is solved in closed form, including stops and breakaway
/// under Coulomb friction: the result does not depend on the step size.
class SimulatedDevice final : public HapticDevice {
 public:
  /// A device at rest at this position [m], held with this grip; by default not held.
  /// @throws ValueError naming the value when the device or the grip is not physical, when the apparent mass is
  /// unknown, or when a translation is not sensed or not driven
  explicit SimulatedDevice(const Capabilities& device, const GripImpedance& grip = {0.0, 0.0, 0.0},
                           const Eigen::Vector3d& position = Eigen::Vector3d::Zero());

  const Capabilities& capabilities() const noexcept override { return device_; }
  /// The sample taken `sample_delay` ticks ago. Its velocity is measured or estimated, as on the device: the true one
  /// at that time, or an estimate from the quantised positions of the samples, one per advance(). Its force is the one
  /// applied now.
  DeviceState read() noexcept override;
  /// Applies the device's output_force() for this one. A force that is not finite counts as zero, as on every device;
  /// refused_forces() counts such forces for tests of force laws.
  void write(const Eigen::Vector3d& force) noexcept override;
  void close() noexcept override;

  /// Sets the intended position, initially the start position. Every advance() moves it at its velocity. Values that
  /// are not finite are ignored.
  void set_intention(const Intention& intention) noexcept;
  /// Sets the grip of the hand that holds the device; all zero: it is not held.
  /// @throws ValueError naming the value when the grip is not physical
  void set_grip(const GripImpedance& grip);
  /// Sets the pressed buttons, one bit for each; takes effect with the next advance().
  void set_buttons(std::uint32_t buttons) noexcept { buttons_ = buttons; }

  /// Replaces the schedule of faults, by default empty. If several are active at once, the first applies. Allocates, so
  /// do not call it while a servo loop runs. @throws ValueError naming the fault and the value that is out of range
  void schedule(std::vector<SimulatedFault> faults);

  /// Advances virtual time by `seconds` and takes a sample; 0 does nothing. A call follows at most 256 stops along an
  /// axis; after that the axis stays at rest until the call ends. @throws ValueError naming a time that is negative or
  /// not finite
  void advance(double seconds);

  /// Unquantised position of the haptic interface point [m].
  const Eigen::Vector3d& true_position() const noexcept { return position_; }
  /// Its velocity, neither quantised nor filtered [m/s].
  const Eigen::Vector3d& true_velocity() const noexcept { return velocity_; }
  /// The force at work, after every limit of the device [N].
  const Eigen::Vector3d& applied_force() const noexcept { return force_; }
  /// Forces written so far that were not finite.
  std::uint64_t refused_forces() const noexcept { return refused_forces_; }
  /// Virtual time, the sum of all advances [s].
  double time() const noexcept { return time_; }

 private:
  DeviceState sample(double elapsed) noexcept;
  const SimulatedFault& current_fault() const noexcept;
  bool unplugged() const noexcept;

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
  std::uint64_t refused_forces_ = 0;
  std::vector<DeviceState> samples_;  ///< ring buffer, long enough for the sample delay and the latest fault
  std::size_t newest_ = 0;
  std::vector<SimulatedFault> faults_;
  DeviceState last_read_;  ///< the last read before the current fault
};

}  // namespace calligraphy
