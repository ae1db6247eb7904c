#include <calligraphy/devices/force_guard.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <calligraphy/base/error.hpp>

namespace calligraphy {
namespace {

double checked(const char* name, double value, double largest) {
  if (std::isfinite(value) && value >= 0.0 && value <= largest) return value;
  std::ostringstream message;
  message << name << " of the force is " << value << " s, must be from 0 to " << largest << " s";
  throw ValueError(message.str());
}

}  // namespace

const char* phase_name(ServoPhase phase) noexcept {
  switch (phase) {
    case ServoPhase::zero:
      return "zero";
    case ServoPhase::rising:
      return "rising";
    case ServoPhase::running:
      return "running";
    case ServoPhase::falling:
      return "falling";
  }
  return "unknown";
}

ForceGuard::ForceGuard(double fall_time, double rise_time)
    : fall_time_(checked("fall time", fall_time, 0.1)), rise_time_(checked("rise time", rise_time, 10.0)) {}

const Eigen::Vector3d& ForceGuard::pass(const Eigen::Vector3d& wanted, double elapsed) noexcept {
  if (phase_ == ServoPhase::falling) return hold(elapsed);
  if (phase_ == ServoPhase::zero) {
    phase_ = ServoPhase::rising;
    gain_ = 0.0;
  }
  if (phase_ == ServoPhase::rising) {
    gain_ = rise_time_ > 0.0 ? gain_ + elapsed / rise_time_ : 1.0;
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
  gain_ = fall_time_ > 0.0 ? gain_ - elapsed / fall_time_ : 0.0;
  // Sums of ticks that should end at zero end at some 1e-16 of it.
  if (gain_ > 1e-9) {
    force_ = gain_ * held_;
  } else {
    gain_ = 0.0;
    force_.setZero();
    phase_ = ServoPhase::zero;
  }
  return force_;
}

const Eigen::Vector3d& ForceGuard::fall(DeviceFault fault, double elapsed, double longest_first) noexcept {
  fault_ = fault;
  if (phase_ == ServoPhase::zero || phase_ == ServoPhase::falling) return hold(elapsed);
  phase_ = ServoPhase::falling;
  held_ = force_;
  gain_ = 1.0;
  return hold(std::min(elapsed, longest_first));
}

void ForceGuard::reset() noexcept {
  phase_ = ServoPhase::zero;
  fault_ = DeviceFault::none;
  gain_ = 0.0;
  force_.setZero();
}

}  // namespace calligraphy
