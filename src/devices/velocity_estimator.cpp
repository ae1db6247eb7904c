#include <calligraphy/devices/velocity_estimator.hpp>

#include <cmath>
#include <numbers>

#include "base/require.hpp"

namespace calligraphy {
namespace {

/// Zero times infinity or NaN is NaN.
bool is_finite(const Eigen::Vector3d& vector) noexcept {
  return 0.0 * vector.x() + 0.0 * vector.y() + 0.0 * vector.z() == 0.0;
}

}  // namespace

VelocityEstimator::VelocityEstimator(double cutoff) : cutoff_(2.0 * std::numbers::pi * cutoff) {
  require_above_zero("cut-off frequency of the velocity", cutoff, "Hz");
}

const Eigen::Vector3d& VelocityEstimator::update(const Eigen::Vector3d& position, double elapsed) noexcept {
  if (has_position_) {
    if (!(elapsed > 0.0 && std::isfinite(elapsed))) return velocity_;
    since_position_ += elapsed;
  }
  if (!is_finite(position)) return velocity_;
  if (has_position_) {
    const Eigen::Vector3d difference = (position - position_) / since_position_;
    if (since_position_ != share_time_) {
      share_time_ = since_position_;
      share_ = -std::expm1(-cutoff_ * since_position_);
    }
    const Eigen::Vector3d smoothed = velocity_ + share_ * (difference - velocity_);
    if (is_finite(smoothed)) velocity_ = smoothed;  // differences near the largest double overflow
  }
  has_position_ = true;
  position_ = position;
  since_position_ = 0.0;
  return velocity_;
}

void VelocityEstimator::restart() noexcept {
  has_position_ = false;
  since_position_ = 0.0;
  velocity_.setZero();
}

}  // namespace calligraphy
