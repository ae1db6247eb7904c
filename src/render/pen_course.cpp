#include "pen_course.hpp"

#include <algorithm>
#include <limits>

#include "collision/length.hpp"

namespace calligraphy {
namespace {

/// Minimum encoder step, also for a sensor that states none: in a hand no device is finer [m].
constexpr double min_encoder_step = 30e-6;

/// Noise of rounding three positions, each along three axes, and of an encoder that steps to and fro along one of them:
/// at most |(2, 2, 2) + (2, 0, 0)|.
constexpr double noise_in_steps = 5.0;

/// Share of the possible range that a hand uses all the time.
constexpr double usual_share = 0.6;

/// A sensor whose own clock is a little slower than the loop repeats a sample now and then without saying so: a moving
/// pen may be shown in the same place for this long [ticks].
constexpr double max_wait = 3.6;

/// Unreported jitter of the ticks, and the shortest interval that gives a velocity [ticks].
constexpr double jitter = 1.0, min_interval = 0.5;

/// Squared distance from the end of `way` to the segment that ends at `course`.
double square_beside(const Eigen::Vector3d& way, const Eigen::Vector3d& course) noexcept {
  const double length = dot(course, course);
  const double share = length > 0.0 ? std::clamp(dot(way, course) / length, 0.0, 1.0) : 0.0;
  const Eigen::Vector3d beside = way - course * share;
  return dot(beside, beside);
}

}  // namespace

PenCourse::PenCourse(const ForceLimits& limits, const Capabilities& device, double period, double scale)
    : max_speed_(limits.max_speed * scale),
      max_acceleration_(limits.max_acceleration * scale),
      noise_(noise_in_steps * std::max(device.encoder_step, min_encoder_step) * scale),
      period_(period),
      took_(period) {}

void PenCourse::begin(const Eigen::Vector3d& position, bool at_rest) noexcept {
  position_ = position;
  way_.setZero();
  took_ = at_rest ? period_ : std::numeric_limits<double>::infinity();
  waited_ = 0.0;
}

PenCourse::Step PenCourse::step(const Eigen::Vector3d& position, double elapsed) const noexcept {
  Step step;
  // Holds for a clock that stands or runs backwards too.
  step.passed = waited_ + (elapsed > 0.0 ? std::max(elapsed, min_interval * period_) : period_);
  step.way = position - position_;
  step.square = dot(step.way, step.way);
  const double farthest = max_speed_ * std::max(step.passed, period_);
  step.is_too_far = step.square > farthest * farthest;
  return step;
}

PenCourse::Place PenCourse::classify(const Step& step) const noexcept {
  if (step.is_too_far) [[unlikely]] return Place::impossible;
  // Mean velocities over two intervals are those at their midpoints.
  const double margin = noise_ + max_acceleration_ * 0.5 * (took_ + step.passed) * step.passed;
  const double usual = usual_share * margin;
  if (step.square <= usual * usual) [[likely]] return Place::expected;
  const Eigen::Vector3d per_second = way_ * (1.0 / took_);
  if (square_beside(step.way, per_second * step.passed) <= usual * usual) return Place::expected;
  const Eigen::Vector3d farthest = per_second * (step.passed + jitter * period_);
  return square_beside(step.way, farthest) <= margin * margin ? Place::possible : Place::impossible;
}

void PenCourse::add(const Eigen::Vector3d& position, const Step& step) noexcept {
  if (step.square == 0.0 && step.passed <= max_wait * period_ && !way_.isZero(0.0)) {  // it may be a repeated sample
    waited_ = step.passed;
    return;
  }
  waited_ = 0.0;
  way_ = step.way;
  if (step.is_too_far) way_.setZero();
  took_ = step.passed;
  position_ = position;
}

}  // namespace calligraphy
