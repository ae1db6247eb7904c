#include <calligraphy/devices/detail/force_guard.hpp>

#include <algorithm>

#include <calligraphy/devices/servo.hpp>

#include "base/require.hpp"

namespace calligraphy::detail {
namespace {

double checked(const char* name, double value, double largest) {
  require_within(name, value, "s", 0.0, largest);
  return value;
}

}  // namespace

ForceGuard::ForceGuard(double ramp_down, double ramp_up)
    : ramp_down_(checked("servo loop: ramp_down", ramp_down, 0.1)),
      ramp_up_(checked("servo loop: ramp_up", ramp_up, 10.0)) {}

const Eigen::Vector3d& ForceGuard::pass(const Eigen::Vector3d& wanted, double elapsed) noexcept {
  if (phase_ == ServoPhase::falling) return hold(elapsed);
  if (phase_ == ServoPhase::zero) {
    phase_ = ServoPhase::rising;
    gain_ = 0.0;
  }
  if (phase_ == ServoPhase::rising) {
    gain_ = ramp_up_ > 0.0 ? gain_ + elapsed / ramp_up_ : 1.0;
    if (gain_ >= 1.0) {
      gain_ = 1.0;
      phase_ = ServoPhase::running;
      fault_ = DeviceFault::none;
    }
  }
  force_ = gain_ * wanted;
  return force_;
}

const Eigen::Vector3d& ForceGuard::hold(double elapsed) noexcept {
  if (phase_ != ServoPhase::falling) return force_;
  gain_ = ramp_down_ > 0.0 ? gain_ - elapsed / ramp_down_ : 0.0;
  // Rounding leaves sums of ticks about 1e-16 off zero.
  if (gain_ > 1e-9) {
    force_ = gain_ * held_;
  } else {
    gain_ = 0.0;
    force_.setZero();
    phase_ = ServoPhase::zero;
  }
  return force_;
}

const Eigen::Vector3d& ForceGuard::fall(DeviceFault fault, double elapsed, double max_first_step) noexcept {
  fault_ = fault;
  if (phase_ == ServoPhase::zero || phase_ == ServoPhase::falling) return hold(elapsed);
  phase_ = ServoPhase::falling;
  held_ = force_;
  gain_ = 1.0;
  return hold(std::min(elapsed, max_first_step));
}

void ForceGuard::reset() noexcept { cut(DeviceFault::none); }

void ForceGuard::cut(DeviceFault fault) noexcept {
  phase_ = ServoPhase::zero;
  fault_ = fault;
  gain_ = 0.0;
  force_.setZero();
}

}  // namespace calligraphy::detail
