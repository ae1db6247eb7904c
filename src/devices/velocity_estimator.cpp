#include <calligraphy/devices/velocity_estimator.hpp>

#include <cmath>
#include <numbers>

#include "base/require.hpp"

namespace calligraphy {

VelocityEstimator::VelocityEstimator(double cutoff) : cutoff_(2.0 * std::numbers::pi * cutoff) {
  require_above_zero("cut-off frequency of the velocity", cutoff, "Hz");
}

void VelocityEstimator::learn_share() noexcept {
  share_time_ = since_position_;
  share_ = -std::expm1(-cutoff_ * share_time_);
}

void VelocityEstimator::restart() noexcept {
  has_position_ = false;
  share_ = share_time_ = 0.0;  // the same bits as a new estimator, whatever came before
  since_position_ = 0.0;
  velocity_.setZero();
}

}  // namespace calligraphy
