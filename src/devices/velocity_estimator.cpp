#include <calligraphy/devices/velocity_estimator.hpp>

#include <cmath>
#include <numbers>

#include "base/require.hpp"

namespace calligraphy {
namespace {

/// 1 - exp(-x), to 1e-13 for |x| <= small: clocks jitter by no more than that, in the exponent of the low-pass.
constexpr double small = 0.02;
double rise(double x) noexcept {
  return x * (1.0 - x * (1.0 / 2.0 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x * (1.0 / 120.0)))));
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
  if (has_position_) {
    if (!(elapsed > 0.0 && std::isfinite(elapsed))) return velocity_;
    since_position_ += elapsed;
  }
  if (!is_finite(position)) return velocity_;
  if (has_position_) {
    const Eigen::Vector3d difference = (position - position_) / since_position_;
    // What is left after this interval is left after the one whose share is known, and after what it is longer by.
    double longer = cutoff_ * (since_position_ - share_time_);
    if (!(std::abs(longer) <= small)) [[unlikely]] {
      share_time_ = since_position_;
      share_ = -std::expm1(-cutoff_ * share_time_);
      longer = 0.0;
    }
    const double share = share_ + (1.0 - share_) * rise(longer);
    const Eigen::Vector3d smoothed = velocity_ + share * (difference - velocity_);
    if (is_finite(smoothed)) velocity_ = smoothed;  // differences near the largest double overflow
  }
  has_position_ = true;
  position_ = position;
  since_position_ = 0.0;
  return velocity_;
}

void VelocityEstimator::restart() noexcept {
  has_position_ = false;
  share_ = share_time_ = 0.0;  // the same bits again, whatever has been before
  since_position_ = 0.0;
  velocity_.setZero();
}

}  // namespace calligraphy
