#include "encoder_watch.hpp"

#include <algorithm>
#include <cmath>

#include "devices/phantom/wire/wrapping_count.hpp"

namespace calligraphy::phantom {
namespace {

constexpr double fastest = 60.0;          // [rad/s]
constexpr double max_change = 20.0;       // of the speed between reports [rad/s]
constexpr double rounding = 3.0;          // error of a change of speed [counts]
constexpr double compared_within = 5e-3;  // over a longer interval, changes of speed are not checked [s]
constexpr int leaps_to_give_up = 5;
constexpr double travel_step = 0.01;        // [rad]
constexpr double travel_while_stuck = 2.5;  // [rad]

}  // namespace

EncoderWatch::EncoderWatch(const PerJoint<Field>& fields, const Eigen::Vector3d& counts_per_radian)
    : bits_{fields[0].bits, fields[1].bits, fields[2].bits}, counts_per_radian_(counts_per_radian) {}

EncoderWatch::Result EncoderWatch::check(const PerJoint<std::int64_t>& shown, double elapsed, bool even) noexcept {
  if (!started_) {
    started_ = true;
    shown_ = shown;
    return {};
  }
  since_used_ += elapsed;
  PerJoint<std::int64_t> steps{};
  Eigen::Vector3d moved;
  for (std::size_t joint = 0; joint < 3; ++joint) {
    steps[joint] = min_step(shown_[joint], shown[joint], bits_[joint]);
    const auto index = static_cast<Eigen::Index>(joint);
    moved[index] = static_cast<double>(steps[joint]) / counts_per_radian_[index];
  }
  const double interval = std::max(since_used_, 1e-6);
  const Eigen::Vector3d velocity = moved / interval;
  if (leaps(velocity, interval, even)) {
    if (++leaps_ < leaps_to_give_up) return {false, false, DeviceFault::leaping_encoder};
    restart();
    started_ = true;
    shown_ = shown;
    return {true, true, DeviceFault::leaping_encoder};
  }
  leaps_ = 0;
  shown_ = shown;
  for (std::size_t joint = 0; joint < 3; ++joint) total_[joint] += steps[joint];
  velocity_ = velocity;
  has_velocity_ = true;
  interval_ = interval;
  since_used_ = 0.0;
  return {true, false, stuck(moved) ? DeviceFault::stuck_encoder : DeviceFault::none};
}

void EncoderWatch::restart() noexcept {
  started_ = false;
  has_velocity_ = false;
  leaps_ = 0;
  total_ = {};
  velocity_.setZero();
  interval_ = 0.0;
  since_used_ = 0.0;
  anchor_.setZero();
  travel_.setZero();
  travel_when_moved_.setZero();
}

void EncoderWatch::interrupt() noexcept {
  since_used_ = 1.0;  // long enough for any movement
}

Eigen::Vector3d EncoderWatch::angles() const noexcept {
  return Eigen::Vector3d(static_cast<double>(total_[0]), static_cast<double>(total_[1]), static_cast<double>(total_[2]))
      .cwiseQuotient(counts_per_radian_);
}

bool EncoderWatch::leaps(const Eigen::Vector3d& velocity, double interval, bool even) const noexcept {
  if (velocity.cwiseAbs().maxCoeff() > fastest) return true;
  if (!even || !has_velocity_ || interval > compared_within) return false;
  const Eigen::Vector3d rounded = rounding / interval * counts_per_radian_.cwiseAbs().cwiseInverse();
  return ((velocity - velocity_).cwiseAbs() - rounded).maxCoeff() > max_change;
}

bool EncoderWatch::stuck(const Eigen::Vector3d& moved) noexcept {
  const Eigen::Vector3d at = angles();
  for (Eigen::Index joint = 0; joint < 3; ++joint) {
    const double way = std::abs(at[joint] - anchor_[joint]);
    if (way < travel_step) continue;
    travel_[joint] += way;
    anchor_[joint] = at[joint];
  }
  double longest = 0.0;  // travel of one joint while another was stationary
  for (Eigen::Index joint = 0; joint < 3; ++joint) {
    if (moved[joint] != 0.0) travel_when_moved_.col(joint) = travel_;
    longest = std::max(longest, (travel_ - travel_when_moved_.col(joint)).maxCoeff());
  }
  return longest > travel_while_stuck;
}

}  // namespace calligraphy::phantom
