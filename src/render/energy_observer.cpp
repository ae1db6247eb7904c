#include <calligraphy/render/detail/energy_observer.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "collision/length.hpp"

namespace calligraphy::detail {
namespace {

/// A sample that implies a faster pen is not a motion: the pen is elsewhere [m/s].
constexpr double max_pen_speed = 10.0;

/// A device that renders a force this closely has held it: devices round to their resolution [N].
constexpr double force_resolution = 0.01;

}  // namespace

EnergyObserver::EnergyObserver(const EnergyObserverOptions& options, double period) noexcept
    : options_(options),
      period_(period),
      rate_(1.0 / period),
      delay_(static_cast<std::size_t>(std::clamp(options.delay, 0, max_delay))) {
  restart();
}

void EnergyObserver::restart() noexcept {
  sent_.fill(Eigen::Vector3d::Zero());
  has_position_ = false;
  at_last_sample_ = velocity_ = Eigen::Vector3d::Zero();
  gap_ = {};
  speed_ = given_ = 0.0;
}

double EnergyObserver::speed() const noexcept { return std::max(options_.hand_speed, speed_); }

[[gnu::noinline]] void EnergyObserver::acted_over_pause(const Eigen::Vector3d& force, int missed,
                                                        double settling) noexcept {
  const double settled = std::round(settling / period_);  // [ticks]
  Eigen::Vector3d before = sent_[newest_];
  double change = norm(Eigen::Vector3d(force - before));
  const Eigen::Vector3d earlier = std::exchange(at_last_sample_, force);
  if (settled > 0.0) {
    // The force sent arrived late, or never: until then the previous one acted.
    change = std::max({change, norm(Eigen::Vector3d(earlier - before)), norm(Eigen::Vector3d(force - earlier))});
    if (norm(earlier) > norm(before)) before = earlier;
  }
  // A force that was reduced meanwhile lay between the two, at an unknown time.
  const double max_unsure = std::max(std::ceil(options_.max_gap / period_), settled);
  const int unsure =
      change <= force_resolution / options_.scale ? 0 : static_cast<int>(std::min(max_unsure, 1.0 * missed));
  if (unsure > 0) sent_[newest_] = before;
  pass_unseen(before, unsure, change);
  if (unsure > 0 && settled > missed && has_position_) {  // also in the period that ends now
    gap_.force += change;
    gap_.change += change;
  }
  // Within a period each force has its share of the time, and so of the way.
  if (unsure == 0) sent_[newest_] = force + std::min(settling / period_, 1.0) * (earlier - force);
  pass_unseen(force, missed - unsure, 0.0);
  sent_[newest_] = force;
}

/// Passes `count` such periods while `force` is held, in bounded time: once it fills the ring, all are alike.
void EnergyObserver::pass_unseen(const Eigen::Vector3d& force, int count, double change) noexcept {
  const int first = std::min(count, static_cast<int>(sent_.size()));
  for (int i = 0; i < first; ++i) {
    pass_unseen(change);
    sent(force);
  }
  if (!has_position_) return;
  const int rest = count - first;
  gap_.periods += rest;
  gap_.force += rest * norm(force);
  gap_.change += rest * (norm(Eigen::Vector3d(force - gap_.held)) + change);
}

/// Passes a period that ends at an unknown position; the force at work is known up to a `change` [N].
void EnergyObserver::pass_unseen(double change) noexcept {
  velocity_.setZero();
  if (!has_position_) return;
  const Eigen::Vector3d& force = force_at_work();
  if (gap_.periods == 0) gap_.held = force;
  ++gap_.periods;
  gap_.force += norm(force);
  gap_.change += norm(Eigen::Vector3d(force - gap_.held)) + change;
}

ObservedStep EnergyObserver::move(const Eigen::Vector3d& position) noexcept {
  ObservedStep step;
  step.force = force_at_work();
  if (has_position_) step.way = position - position_;
  const double square = dot(step.way, step.way), reach = max_pen_speed * options_.scale * period_;
  if (has_position_ && gap_.periods == 0 && square <= reach * reach) {
    step.energy = dot(step.force, step.way);
    step.seen = true;
    velocity_ = step.way * rate_;
    const double by_hand = options_.hand_speed * period_;
    speed_ = square > by_hand * by_hand ? std::sqrt(square) * rate_ : 0.0;
  } else {
    move_after_gap(step);
  }
  given_ += step.energy;
  has_position_ = true;
  position_ = position;
  return step;
}

/// Also after a step that no pen could take.
[[gnu::noinline]] void EnergyObserver::move_after_gap(ObservedStep& step) noexcept {
  const double way = norm(step.way), seconds = static_cast<double>(gap_.periods + 1) * period_;
  const bool jumped = way > max_pen_speed * options_.scale * seconds;
  if (!has_position_) {
    // Without a first position nothing is known of the work: the force was zero then, or is charged from now on.
  } else if (jumped) {
    step.energy = (gap_.force + norm(step.force)) * speed() * period_;  // the pen did not move there
  } else {
    // Exact if the force was held; otherwise it is unknown how far the pen moved under which force.
    const double max_speed = std::max(speed(), way / seconds);
    const double change = gap_.change + norm(Eigen::Vector3d(step.force - gap_.held));
    step.energy = std::min(dot(gap_.held, step.way) + change * max_speed * period_,
                           (gap_.force + norm(step.force)) * max_speed * period_);
  }
  speed_ = has_position_ && !jumped ? way / seconds : 0.0;
  gap_ = {};
}

}  // namespace calligraphy::detail
