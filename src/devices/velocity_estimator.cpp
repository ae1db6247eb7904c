#include <calligraphy/devices/velocity_estimator.hpp>

#include <cmath>
#include <numbers>

#include "base/require.hpp"

namespace calligraphy {

VelocityEstimator::VelocityEstimator(double cutoff) : cutoff_(2.0 * std::numbers::pi * cutoff) {
  require_above_zero("cut-off frequency of the velocity", cutoff, "Hz");
}

const Eigen::Vector3d& VelocityEstimator::update(const Eigen::Vector3d& position, double elapsed) noexcept {
  if (has_position_) {
    if (!(elapsed > 0.0 && std::isfinite(elapsed))) return velocity_;
    since_position_ += elapsed;
  }
  if (!position.allFinite()) return velocity_;
  if (has_position_) {
    const Eigen::Vector3d difference = (position - position_) / since_position_;
    const double share = -std::expm1(-cutoff_ * since_position_);
    const Eigen::Vector3d smoothed = velocity_ + share * (difference - velocity_);
    if (smoothed.allFinite()) velocity_ = smoothed;  // differences near the largest double overflow
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
