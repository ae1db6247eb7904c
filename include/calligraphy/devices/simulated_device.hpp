// A simulated Phantom and the hand that holds it, integrated exactly between samples.
#pragma once

#include <vector>

#include <calligraphy/devices/haptic_device.hpp>

namespace calligraphy {

/// Where the person means the pen to be, in device axes.
struct Intention {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< [m/s]
};

/// A device in virtual time. Between two calls of advance() the commanded force is held and the intention moves in a
/// straight line, so that the motion along each axis is solved in closed form, Coulomb friction with its stops and
/// starts included: the answer does not depend on the size of the step.
class SimulatedDevice final : public HapticDevice {
 public:
  /// @throws ValueError naming the value when the device or the hand is not physical, when the apparent mass is not
  /// known, and when a translation is not sensed or not driven
  explicit SimulatedDevice(const Capabilities& device, const Hand& hand = {0.0, 0.0, 0.0},
                           const Eigen::Vector3d& position = Eigen::Vector3d::Zero());

  const Capabilities& capabilities() const noexcept override { return device_; }
  /// The sample of `sample_delay` ticks ago; its velocity is the true one of that moment.
  DeviceState read() noexcept override;
  /// Force beyond the peak is shortened to it, its direction kept.
  void write(const Eigen::Vector3d& force) noexcept override;
  void close() noexcept override;

  /// Where the hand pulls to from now on; until the first call it holds the start position. Moves on along its line
  /// with every advance(). One that is not finite is ignored.
  void set_intention(const Intention& intention) noexcept;
  /// @throws ValueError naming the value when the hand is not physical
  void set_hand(const Hand& hand);
  /// Seen by the samples of later advances.
  void set_buttons(std::uint32_t buttons) noexcept { buttons_ = buttons; }

  /// Lets `seconds` of virtual time pass and takes a sample; nothing happens unless it is finite and above 0.
  /// Along each axis at most 256 stops are followed in one call; then the axis rests until its end.
  void advance(double seconds) noexcept;

  /// What no encoder sees: the true motion and the force at work.
  const Eigen::Vector3d& true_position() const noexcept { return position_; }
  const Eigen::Vector3d& true_velocity() const noexcept { return velocity_; }
  const Eigen::Vector3d& applied_force() const noexcept { return force_; }
  double time() const noexcept { return time_; }

 private:
  DeviceState sample() const noexcept;

  Capabilities device_;
  Hand hand_;
  Intention intention_;
  Eigen::Vector3d position_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
  double time_ = 0.0;
  std::uint32_t buttons_ = 0;
  bool open_ = true;
  std::vector<DeviceState> samples_;  ///< ring of the last sample_delay + 1 samples
  std::size_t newest_ = 0;
};

}  // namespace calligraphy
