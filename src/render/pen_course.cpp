#include <calligraphy/render/detail/pen_course.hpp>

#include <algorithm>
#include <limits>

#include "collision/length.hpp"

namespace calligraphy {
namespace {

/// Of a sensor that states none: a device is no finer in a hand [m].
constexpr double min_encoder_step = 30e-6;

/// Rounding of three positions, each along three axes, and one step to and fro along one of them, as encoders have it:
/// |(2, 2, 2) + (2, 0, 0)| at most.
constexpr double noise_in_steps = 5.0;

/// A sensor whose own clock is a little slower than the loop repeats a sample now and then, unflagged [ticks].
constexpr double max_repetition = 1.6;

/// Ticks are late or early by so much where nobody says so, and intervals too short to tell a velocity [ticks].
constexpr double jitter = 1.0, min_interval = 0.5;

}  // namespace

PenCourse::PenCourse(const ForceLimits& limits, const Capabilities& device, double period, double scale)
    : max_speed_(limits.max_speed * scale),
      max_acceleration_(limits.max_acceleration * scale),
      noise_(noise_in_steps * std::max(device.encoder_step, min_encoder_step) * scale),
      period_(period),
      measured_over_(period) {}

void PenCourse::begin(const Eigen::Vector3d& position, bool at_rest) noexcept {
  position_ = position;
  velocity_.setZero();
  measured_over_ = at_rest ? period_ : std::numeric_limits<double>::infinity();
  waited_ = 0.0;
}

/// Of a clock that stands or runs backwards too.
double PenCourse::since_shown(double elapsed) const noexcept {
  return waited_ + (elapsed > 0.0 ? std::max(elapsed, min_interval * period_) : period_);
}

void PenCourse::add(const Eigen::Vector3d& position, double elapsed) noexcept {
  const double passed = since_shown(elapsed);
  const bool may_be_repeated = position == position_ && passed <= max_repetition * period_ && !velocity_.isZero(0.0);
  waited_ = may_be_repeated ? passed : 0.0;
  if (may_be_repeated) return;
  velocity_ = shortened((position - position_) / passed, max_speed_);
  measured_over_ = passed;
  position_ = position;
}

bool PenCourse::permits(const Eigen::Vector3d& position, double elapsed) const noexcept {
  const double passed = since_shown(elapsed);
  const Eigen::Vector3d way = position - position_;
  const double square = dot(way, way);
  const double farthest = max_speed_ * std::max(passed, period_);
  if (square > farthest * farthest) return false;
  // Means over two intervals are those in their middles.
  const double margin = noise_ + max_acceleration_ * 0.5 * (measured_over_ + passed) * passed;
  if (square <= margin * margin) return true;
  const Eigen::Vector3d expected = velocity_ * (passed + jitter * period_);
  const double length = dot(expected, expected);
  if (length == 0.0) return false;
  const Eigen::Vector3d beside = way - expected * std::clamp(dot(way, expected) / length, 0.0, 1.0);
  return dot(beside, beside) <= margin * margin;
}

}  // namespace calligraphy
