// Guard between a force law and a device: ramps the force down on a fault and up again on recovery.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include <calligraphy/devices/device_state.hpp>

namespace calligraphy {
enum class ServoPhase : std::uint8_t;  // servo.hpp
namespace detail {

/// Converts desired forces into forces that are safe to output. On a fault, the last output ramps down linearly to zero
/// within `ramp_down`, its direction preserved; the ramp always completes, even if the fault clears sooner. Then the
/// gain on the desired force ramps up from 0 to 1 within `ramp_up`. Each call is one tick; `elapsed` is the time since
/// the previous one [s].
class ForceGuard {
 public:
  /// @throws ValueError naming the value unless ramp_down is 0 to 0.1 s and ramp_up is 0 to 10 s
  ForceGuard(double ramp_down, double ramp_up);

  /// Normal tick: returns the force to output for the desired force, which must be finite [N].
  const Eigen::Vector3d& pass(const Eigen::Vector3d& wanted, double elapsed) noexcept;

  /// Tick without a fresh sample: returns the last force again, or the next one of a ramp-down.
  const Eigen::Vector3d& hold(double elapsed) noexcept;

  /// Fault: starts or continues the ramp-down. Its first tick counts as at most `max_first_step` [s], so that a clock
  /// jump does not cause a force step.
  const Eigen::Vector3d& fall(DeviceFault fault, double elapsed, double max_first_step) noexcept;

  /// Sets the force to zero immediately, for this reason; the next force ramps up from there.
  void cut(DeviceFault fault) noexcept;

  void reset() noexcept;

  ServoPhase phase() const noexcept { return phase_; }
  /// Factor applied to the desired force, or during a ramp-down to the last good force, 0 to 1.
  double gain() const noexcept { return gain_; }
  /// Cause of the last ramp-down, until the force has ramped up again.
  DeviceFault fault() const noexcept { return fault_; }
  const Eigen::Vector3d& force() const noexcept { return force_; }

 private:
  double ramp_down_;
  double ramp_up_;
  ServoPhase phase_ = {};
  DeviceFault fault_ = DeviceFault::none;
  double gain_ = 0.0;
  Eigen::Vector3d held_ = Eigen::Vector3d::Zero();   ///< the force being ramped down
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();  ///< last output
};

}  // namespace detail
}  // namespace calligraphy
