#include "pen_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/length.hpp"

namespace calligraphy {
namespace {

/// Maximum time over which eq. (3) integrates in one tick [s].
constexpr double max_integration_time = 0.1;

/// Time for which the force is held while samples are stale [s].
constexpr double max_hold_time = 4e-3;

/// Time after the start, a gap or a bad sample during which the force follows the pen only at its limited rate: some
/// samples of a noisy sensor are always near by chance, and the velocity is that of an unseen pen. After a step that
/// only a jerk explains, as long as the velocity filter remembers it [s].
constexpr double max_unsure_time = 0.01, jerk_time = 0.003;

/// Hysteresis: the pen is above the paper once it is this far above it [m].
constexpr double lift_height = 0.0005;

/// A pause is at least this long; what is shorter is jitter [ticks].
constexpr double min_pause = 1.75;

/// A clock that counts milliseconds leaps by 1000 ticks from sample to sample; no loop pauses that long that often.
constexpr double min_leap = 300.0;
constexpr int max_leaps = 50;

/// A change of force that moves the pen by tenths of a millimetre in any hand, and how many times the dry friction of
/// the device is added to it: friction can withstand a change of twice its size, and is an estimate [N].
constexpr double unfelt_force = 0.5, frictions = 4.0;

/// False for NaN too.
bool is_on_page(const Eigen::Vector3d& position) noexcept {
  constexpr double most = PenSensor::max_coordinate;
  if (dot(position, position) <= most * most) [[likely]] return true;
  return std::abs(position.x()) <= most && std::abs(position.y()) <= most && std::abs(position.z()) <= most;
}

}  // namespace

PenSensor::PenSensor(const RendererOptions& options, const MotionMapping& mapping, const Capabilities& capabilities)
    : contact_(options.contact),
      mapping_(mapping),
      is_printed_(is_printed(options.rules)),
      max_speed_(options.limits.max_speed * mapping.scale),
      period_(1.0 / options.servo_rate),
      counts_pauses_(options.energy.limited()),
      max_gap_(std::max(max_hold_time, min_pause * period_)),
      max_standstill_(options.limits.max_standstill),
      min_force_change_(unfelt_force + frictions * capabilities.coulomb_friction),
      velocity_(options.velocity_cutoff),
      unsure_for_(max_unsure_time),
      believed_(options.limits, capabilities, period_, mapping.scale),
      doubted_(believed_) {}

void PenSensor::restart() noexcept {
  pen_ = {};
  velocity_.restart();
  has_sample_ = false;
  unseen_ = 0;
  above_for_ = 0.0;
  unsure_for_ = max_unsure_time;
  leaps_ = 0;
  is_in_doubt_ = false;
  still_at_.setConstant(std::numeric_limits<double>::quiet_NaN());
}

PenState& PenSensor::update(const DeviceState& sample, const Eigen::Vector3d& sent) noexcept {
  pen_.time = sample.time;
  pen_.force = sample.force;
  if (counts_pauses_) count_ticks(sample);
  pen_.status = accept(sample, sent);
  unsure_for_ = std::max(0.0, unsure_for_ - period_);
  if (pen_.status == TickStatus::ok) [[likely]] {
    unseen_ = 0;
    pen_.holds_force = false;
    return pen_;
  }
  ++unseen_;
  pen_.holds_force = pen_.status == TickStatus::stale && static_cast<double>(unseen_) * period_ <= max_hold_time;
  if (!pen_.holds_force) unsure_for_ = max_unsure_time;
  return pen_;
}

void PenSensor::count_ticks(const DeviceState& sample) noexcept {
  pen_.ticks = 1;
  pen_.settling = sample.force_settling;
  const bool is_fresh = sample.status == DeviceStatus::ok || sample.status == DeviceStatus::warm_motors;
  if (!has_sample_ || !is_fresh) return;
  const double passed = (sample.time - time_) / period_ - static_cast<double>(unseen_);
  constexpr double most = 1e6;
  if (passed > min_pause) {  // false for NaN, as below
    pen_.ticks = static_cast<int>(std::min(passed + 0.5, most));
  } else if (passed > 1.0) {
    pen_.settling /= passed;  // as a share of a tick that took longer
  }
  unseen_ += pen_.ticks - 1;  // counted once, if this sample turns out to be bad
}

TickStatus PenSensor::accept(const DeviceState& sample, const Eigen::Vector3d& sent) noexcept {
  if (sample.status != DeviceStatus::ok && sample.status != DeviceStatus::warm_motors) [[unlikely]] {
    return sample.status == DeviceStatus::stale ? TickStatus::stale : TickStatus::device_fault;
  }
  const Eigen::Vector3d position = mapping_.to_page(sample.position);
  if (!is_on_page(position) || !std::isfinite(sample.time)) [[unlikely]] return TickStatus::bad_sample;
  if (is_leaping(sample.time)) [[unlikely]] return TickStatus::bad_clock;
  // A clock that stands or runs backwards must not turn a small motion into a fast one.
  const double passed = sample.time - time_;
  double elapsed = passed > period_ ? passed : period_;
  if (max_standstill_ < std::numeric_limits<double>::infinity() &&
      is_frozen(sample.position, is_finite(sample.force) ? sample.force : sent)) [[unlikely]] {
    return TickStatus::bad_sample;
  }
  if (!is_plausible(position, passed)) [[unlikely]] return TickStatus::bad_sample;
  if (!has_sample_) elapsed = period_;
  if (has_sample_ && (passed > max_gap_ || static_cast<double>(unseen_) * period_ >= max_gap_)) [[unlikely]] {
    velocity_.restart();  // the way since then was not seen
    unsure_for_ = max_unsure_time;
  }
  move_device_point(sample, position);
  estimate_motion(position, elapsed);
  feel_paper(elapsed);
  has_sample_ = true;
  time_ = sample.time;
  return TickStatus::ok;
}

bool PenSensor::is_leaping(double time) noexcept {
  const bool leaps = time - clock_ > min_leap * period_;  // false for NaN
  clock_ = time;
  leaps_ = leaps ? std::min(leaps_ + 1, max_leaps) : 0;
  return leaps_ == max_leaps;
}

/// A changing force moves the pen in any hand, if only by one encoder step: a position that meanwhile stays the same to
/// the last bit comes from a dead sensor.
bool PenSensor::is_frozen(const Eigen::Vector3d& position, const Eigen::Vector3d& force) noexcept {
  if (position != still_at_) {
    still_at_ = position;
    still_force_ = force;
    still_for_ = 0.0;
  } else if (still_for_ > 0.0 || norm(force - still_force_) > min_force_change_) {
    still_for_ += period_;
  }
  return still_for_ > max_standstill_;
}

/// A pen cannot jump: a sample off its course is rejected. Once rejected samples form a course of their own, the pen
/// really is elsewhere: either it did not move there, or it is unknown where it was.
bool PenSensor::is_plausible(const Eigen::Vector3d& position, double elapsed) noexcept {
  if (!has_sample_) [[unlikely]] {
    believed_.begin(position, false);
    return true;
  }
  const PenCourse::Step step = believed_.step(position, elapsed);
  const PenCourse::Place place = believed_.classify(step);
  if (place != PenCourse::Place::impossible) [[likely]] {
    believed_.add(position, step);
    if (place == PenCourse::Place::possible) unsure_for_ = std::max(unsure_for_, jerk_time);
  } else {
    bool agrees = false;
    if (is_in_doubt_) {
      const PenCourse::Step doubted = doubted_.step(position, period_);
      agrees = doubted_.classify(doubted) != PenCourse::Place::impossible;
      doubted_.add(position, doubted);
    } else {
      doubted_.begin(position, true);
    }
    is_in_doubt_ = true;
    if (!agrees) return false;
    believed_ = doubted_;
    velocity_.restart();
    has_sample_ = false;
  }
  is_in_doubt_ = false;
  return true;
}

void PenSensor::move_device_point(const DeviceState& sample, const Eigen::Vector3d& position) noexcept {
  if (is_printed_ && has_sample_) {
    const double elapsed = std::clamp(sample.time - time_, 0.0, max_integration_time);
    const Eigen::Vector3d velocity = mapping_.velocity_to_page(sample.velocity);
    const bool is_measured = norm(velocity) <= max_speed_;  // false for NaN too
    pen_.device_point += is_measured ? Eigen::Vector3d(velocity * elapsed) : Eigen::Vector3d(position - pen_.position);
  } else {
    pen_.device_point = position;
  }
  pen_.penetration = std::max(0.0, -pen_.device_point.z());
  pen_.tip = pen_.device_point;
  if (!is_printed_ && pen_.tip.z() < 0.0) pen_.tip.z() = 0.0;
}

void PenSensor::estimate_motion(const Eigen::Vector3d& position, double elapsed) noexcept {
  pen_.last_velocity = pen_.velocity;
  pen_.last_position = pen_.position;
  pen_.velocity = velocity_.update(position, elapsed);
  pen_.position = position;
  if (has_sample_ && unseen_ == 0 && unsure_for_ == 0.0) return;
  // The force has not followed the pen meanwhile, and must not jump to the value it would have, nor follow a sensor
  // that has just been wrong.
  pen_.last_velocity = pen_.velocity;
  pen_.last_position = position;
}

/// A pen that bounces on the paper has not been lifted.
void PenSensor::feel_paper(double elapsed) noexcept {
  const double height = pen_.device_point.z();
  pen_.on_paper = height <= (is_printed_ ? 0.0 : lift_height);
  above_for_ += elapsed;
  if (!pen_.contact) {
    above_for_ = 0.0;
    pen_.contact = height <= 0.0;
  } else if (pen_.on_paper) {
    above_for_ = 0.0;
  } else {
    pen_.contact = height <= contact_.lift_clearance && above_for_ < contact_.lift_time;
  }
}

}  // namespace calligraphy
