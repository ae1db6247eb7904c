// A simulated Phantom and the hand that holds it, integrated exactly between samples.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <calligraphy/devices/haptic_device.hpp>

namespace calligraphy {

/// Physics of a device as a point mass, the same along each axis.
struct DeviceProfile {
  std::string name;
  Capabilities capabilities;
  double mass = 0.0;              ///< apparent mass at the tip [kg]
  double viscous_friction = 0.0;  ///< [N s/m]
  double coulomb_friction = 0.0;  ///< back-drive friction along each axis [N]
  double encoder_step = 0.0;      ///< positions are rounded to multiples of this; 0: not rounded [m]
  int delay = 0;                  ///< age of a sample when it is read [ticks]
};

/// The shipped profiles: omni, touch, desktop, premium-1.5, ideal (no friction, encoder step or delay).
/// Apparent masses and some frictions are estimates, not the vendor's figures: docs/devices.md names each source.
std::span<const DeviceProfile> device_profiles();

/// @throws ValueError naming the name and those that exist
const DeviceProfile& device_profile(std::string_view name);

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
  /// @throws ValueError naming the value when the profile or the hand is not physical
  explicit SimulatedDevice(const DeviceProfile& profile, const Hand& hand = {0.0, 0.0, 0.0},
                           const Eigen::Vector3d& position = Eigen::Vector3d::Zero());

  const Capabilities& capabilities() const noexcept override { return profile_.capabilities; }
  /// The sample of `delay` ticks ago; its velocity is the true one of that moment.
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

  DeviceProfile profile_;
  Hand hand_;
  Intention intention_;
  Eigen::Vector3d position_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
  double time_ = 0.0;
  std::uint32_t buttons_ = 0;
  bool open_ = true;
  std::vector<DeviceState> samples_;  ///< ring of the last delay + 1 samples
  std::size_t newest_ = 0;
};

}  // namespace calligraphy
