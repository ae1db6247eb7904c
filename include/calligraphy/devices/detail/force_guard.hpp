// What stands between a force law and a device: falls to zero at a fault, comes back without a jump.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include <calligraphy/devices/device_state.hpp>

namespace calligraphy {

enum class ServoPhase : std::uint8_t;  // servo.hpp

/// Turns wanted forces into forces that may be sent. After a fault the force last sent falls to zero in `ramp_down`,
/// its direction kept; it always gets there, even when the fault is over sooner. Then the share of the wanted force
/// grows from 0 to 1 in `ramp_up`. Each call is one tick and takes the time since the last one [s].
class ForceGuard {
 public:
  /// @throws ValueError naming the value unless ramp_down is from 0 to 0.1 s and ramp_up from 0 to 10 s
  ForceGuard(double ramp_down, double ramp_up);

  /// All is well: the force that may be sent for the one that is wanted, which must be finite [N].
  const Eigen::Vector3d& pass(const Eigen::Vector3d& wanted, double elapsed) noexcept;

  /// Nothing new is known: the last force again, or the next one of a fall.
  const Eigen::Vector3d& hold(double elapsed) noexcept;

  /// Something is wrong. The first tick of a fall counts as at most `max_first_step`, so that a clock that leapt does
  /// not make the force leap too.
  const Eigen::Vector3d& fall(DeviceFault fault, double elapsed, double max_first_step) noexcept;

  /// Zero at once; the next force rises from there.
  void reset() noexcept;

  ServoPhase phase() const noexcept { return phase_; }
  /// Share of the wanted force that is sent, or of the held one that is left [1].
  double gain() const noexcept { return gain_; }
  /// Why the force fell, until it has risen again.
  DeviceFault fault() const noexcept { return fault_; }
  const Eigen::Vector3d& force() const noexcept { return force_; }

 private:
  double ramp_down_;
  double ramp_up_;
  ServoPhase phase_ = {};
  DeviceFault fault_ = DeviceFault::none;
  double gain_ = 0.0;
  Eigen::Vector3d held_ = Eigen::Vector3d::Zero();   ///< what falls
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();  ///< last sent
};

}  // namespace calligraphy
