#include <calligraphy/devices/velocity_estimator.hpp>

#include <cmath>
#include <limits>
#include <numbers>

#include "base/require.hpp"

namespace calligraphy {
namespace {

/// 1 - exp(-x), to 1e-13 for |x| <= small: clocks jitter by no more than that, in the exponent of the low-pass.
constexpr double small = 0.02;
double rise(double x) noexcept {
  return x * (1.0 + x * (-1.0 / 2.0 + x * (1.0 / 6.0 + x * (-1.0 / 24.0 + x * (1.0 / 120.0)))));
}

/// Zero times infinity or NaN is NaN.
bool is_finite(const Eigen::Vector3d& vector) noexcept {
  return 0.0 * vector.x() + 0.0 * vector.y() + 0.0 * vector.z() == 0.0;
}

}  // namespace

VelocityEstimator::VelocityEstimator(double cutoff) : cutoff_(2.0 * std::numbers::pi * cutoff) {
  require_above_zero("cut-off frequency of the velocity", cutoff, "Hz");
}

const Eigen::Vector3d& VelocityEstimator::update(const Eigen::Vector3d& position, double elapsed) noexcept {
  if (!has_position_) {
    if (!is_finite(position)) return velocity_;
    has_position_ = true;
  } else {
    if (!(elapsed > 0.0 && elapsed < std::numeric_limits<double>::infinity())) return velocity_;
    since_position_ += elapsed;
    const Eigen::Vector3d difference = (position - position_) / since_position_;
    // What is left after this interval is left after the one whose share is known, and after what it is longer by.
    if (!(std::abs(since_position_ - share_time_) * cutoff_ <= small)) learn_share();
    const double share = share_ + (1.0 - share_) * rise(cutoff_ * (since_position_ - share_time_));
    const Eigen::Vector3d smoothed = velocity_ + share * (difference - velocity_);
    if (is_finite(smoothed)) {
      velocity_ = smoothed;
    } else if (!is_finite(position)) {
      return velocity_;  // otherwise the difference has overflowed
    }
  }
  position_ = position;
  since_position_ = 0.0;
  return velocity_;
}

[[gnu::noinline]] void VelocityEstimator::learn_share() noexcept {
  share_time_ = since_position_;
  share_ = -std::expm1(-cutoff_ * share_time_);
}

void VelocityEstimator::restart() noexcept {
  has_position_ = false;
  share_ = share_time_ = 0.0;  // the same bits again, whatever has been before
  since_position_ = 0.0;
  velocity_.setZero();
}

}  // namespace calligraphy
