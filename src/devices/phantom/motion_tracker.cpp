#include "motion_tracker.hpp"

#include <algorithm>

namespace calligraphy::phantom {
namespace {

constexpr int settled_after = 20;        // reports in the inkwell
constexpr double settled_within = 2e-3;  // [rad]
// Tolerance beyond the published joint limits: stops are soft, and a calibration is never exact [rad].
constexpr double limit_margin = 0.15;

}  // namespace

MotionTracker::MotionTracker(const WireProfile& profile, const Linkage& linkage, double velocity_cutoff)
    : linkage_(linkage),
      docked_angles_(*profile.docked_angles),
      period_(1.0 / profile.rate),
      has_sequence_(profile.sequence.has_value()),
      sequence_(has_sequence_ ? profile.sequence->bits : 32),
      encoders_(profile.encoders, *profile.counts_per_radian),
      joint_velocity_(velocity_cutoff),
      offset_(docked_angles_) {}

MotionTracker::Result MotionTracker::take(const RawSample& sample, double now) noexcept {
  Result result;
  result.fault = sample.fault;
  if (!is_readable(sample.fault)) return result;
  SequenceWatch::Result sequence;
  if (has_sequence_) sequence = sequence_.check(sample.sequence);
  if (sequence.fault != DeviceFault::none) result.fault = sequence.fault;
  result.repeated = !sequence.fresh;
  if (!sequence.fresh) return result;
  result.lost = static_cast<std::uint64_t>(sequence.steps - 1);

  double elapsed = static_cast<double>(sequence.steps) * period_;
  if (!has_sequence_) elapsed = std::max(now - last_time_, 0.5 * period_);
  last_time_ = now;
  const EncoderWatch::Result encoders = encoders_.check(sample.encoders, elapsed, has_sequence_);
  if (encoders.fault != DeviceFault::none) result.fault = encoders.fault;
  if (!encoders.used) return result;
  if (encoders.lost_count) {
    offset_ = motion_.joints;  // the best available estimate
    motion_.calibrated = false;
    docked_for_ = 0;
    joint_velocity_.restart();  // the angles have restarted from zero
  }

  motion_.time = now;
  motion_.buttons = sample.buttons;
  follow_docking(sample.docked);
  motion_.joints = offset_ + encoders_.angles();
  motion_.position = tip_position(linkage_, motion_.joints) - linkage_.centre;
  motion_.velocity =
      tip_jacobian(linkage_, motion_.joints) * joint_velocity_.update(encoders_.angles(), encoders_.interval());
  if (motion_.calibrated && !within_limits(linkage_, motion_.joints, limit_margin) &&
      result.fault == DeviceFault::none) {
    result.fault = DeviceFault::outside_workspace;
  }
  result.fresh = true;
  return result;
}

void MotionTracker::follow_docking(bool docked) noexcept {
  motion_.docked = docked;
  const Joints at = encoders_.angles();
  if (!docked) {
    docked_for_ = 0;
    return;
  }
  if (docked_for_ == 0 || (at - docked_at_).cwiseAbs().maxCoeff() > settled_within) {
    docked_at_ = at;
    docked_for_ = 0;
  }
  docked_for_ = std::min(docked_for_ + 1, settled_after + 1);
  if (docked_for_ == settled_after) {
    offset_ = docked_angles_ - at;
    motion_.calibrated = true;
  }
}

void MotionTracker::restart(bool keep_calibration) noexcept {
  sequence_.restart();
  joint_velocity_.restart();
  docked_for_ = 0;
  if (keep_calibration) {
    encoders_.interrupt();
    return;
  }
  encoders_.restart();
  offset_ = docked_angles_;
  motion_.calibrated = false;
}

void MotionTracker::calibrate(const Joints& joints) noexcept {
  offset_ = joints - encoders_.angles();
  motion_.calibrated = true;
}

}  // namespace calligraphy::phantom
