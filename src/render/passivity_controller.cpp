#include <calligraphy/render/passivity_controller.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/require.hpp"

#include "collision/length.hpp"

namespace calligraphy {
namespace {

/// A sample that implies a faster pen is not a motion: the pen is elsewhere [m/s].
constexpr double fastest_pen = 10.0;

/// A pen that bounces is back on the paper within this time [s].
constexpr double longest_flight = 0.05;

constexpr double strongest_brake = 0.1;  ///< with an exhausted budget [N]
constexpr double faintest_share = 0.2;   ///< of the brake with an overdrawn budget
constexpr double oldest_sample = 0.01;   ///< an older velocity says less, and brakes less [s]
constexpr double slow_pen = 0.01;        ///< speed at which half of the brake acts [m/s]

constexpr double viscous_share = 0.15;  ///< of a force that the budget limits, for damping

/// A device that renders a force so nearly has held it: it rounds to its resolution [N].
constexpr double finest_force = 0.01;

/// Damping [N s/m] that dissipates `surplus` [J] within one period; `square` is the squared step of that period [m^2].
double damping_for(double surplus, double square, double period, double most) noexcept {
  if (!(surplus > 0.0) || !(square > 0.0)) return 0.0;
  return std::min(surplus * period / square, most);
}

}  // namespace

double PassivityController::usable_damping(double mass, double period, int delay) noexcept {
  return 0.9 * mass / (period * (1 + 2 * delay));
}

PassivityController::PassivityController(const PassivityOptions& options, double period)
    : max_damping_(options.max_damping),
      budget_(options.energy_budget),
      mass_(options.mass),
      hand_speed_(options.hand_speed),
      max_gap_(options.max_gap),
      scale_(options.scale),
      period_(period),
      delay_(static_cast<std::size_t>(std::max(0, options.delay))) {
  require_not_negative("passivity: max_damping", max_damping_, "N s/m");
  require(budget_ >= 0.0, "passivity: energy_budget", budget_, "J", "at least 0");
  require(mass_ > 0.0, "passivity: mass", mass_, "kg", "above 0");
  require_above_zero("passivity: hand_speed", hand_speed_, "m/s");
  require_not_negative("passivity: max_gap", max_gap_, "s");
  require_above_zero("passivity: scale", scale_, "");
  require_above_zero("passivity: period", period, "s");
  require_within("passivity: delay", options.delay, "ticks", 0, max_delay);
  brake_ = strongest_brake / scale_ * std::min(1.0, oldest_sample / ((options.delay + 1) * period));
  reserve_ = std::min(0.5 * budget_, brake_ * hand_speed_ * (max_gap_ + period));
  restart();
}

void PassivityController::restart() noexcept {
  sent_.fill(Eigen::Vector3d::Zero());
  has_position_ = false;
  wanted_ = damping_ = held_ = at_last_sample_ = Eigen::Vector3d::Zero();
  unseen_ = 0;
  free_for_ = 0.0;
  speed_ = unseen_force_ = unseen_change_ = surplus_in_plane_ = surplus_normal_ = given_ = 0.0;
  max_force_ = std::numeric_limits<double>::infinity();
  left_ = budget_;
}

void PassivityController::acted(const Eigen::Vector3d& force, int ticks, double settling) noexcept {
  const int missed = std::max(0, ticks - 1);
  const double settled = std::round(settling / period_);  // [ticks]
  Eigen::Vector3d before = sent_[newest_];
  double change = norm(Eigen::Vector3d(force - before));
  const Eigen::Vector3d earlier = std::exchange(at_last_sample_, force);
  if (missed > 0 && settled > 0.0) {
    // What was sent came late, or never came: until then the force was the one before.
    change = std::max({change, norm(Eigen::Vector3d(earlier - before)), norm(Eigen::Vector3d(force - earlier))});
    if (norm(earlier) > norm(before)) before = earlier;
  }
  // A force that was reduced meanwhile has been between the two, it is not known when.
  const double longest = std::max(std::ceil(max_gap_ / period_), settled);
  const int unsure = change <= finest_force / scale_ ? 0 : static_cast<int>(std::min(longest, 1.0 * missed));
  if (unsure > 0) sent_[newest_] = before;
  pass_unseen(before, unsure, change);
  if (unsure > 0 && settled > missed && has_position_) {  // also in the period that ends now
    unseen_force_ += change;
    unseen_change_ += change;
  }
  // Within a period each force has its share of the time, and so of the way.
  if (unsure == 0) sent_[newest_] = force + std::min(settling / period_, 1.0) * (earlier - force);
  pass_unseen(force, missed - unsure, 0.0);
  if (missed > 0) sent_[newest_] = force;
}

/// `count` periods in which `force` is held pass like that, in bounded time: once it fills the ring, all are alike.
void PassivityController::pass_unseen(const Eigen::Vector3d& force, int count, double change) noexcept {
  const int first = std::min(count, static_cast<int>(sent_.size()));
  for (int i = 0; i < first; ++i) {
    pass_unseen(change);
    sent(force);
  }
  if (!has_position_) return;
  const int rest = count - first;
  unseen_ += rest;
  unseen_force_ += rest * norm(force);
  unseen_change_ += rest * (norm(Eigen::Vector3d(force - held_)) + change);
}

Eigen::Vector3d PassivityController::next(const Eigen::Vector3d& position, const Eigen::Vector3d& wanted,
                                          const Eigen::Vector3d& viscous) noexcept {
  damping_.setZero();
  // What the budget takes away on purpose is not generated.
  const Eigen::Vector3d field = shortened(wanted, max_force_);
  if (position.allFinite()) {
    move(position, field);
  } else {
    pass_unseen(0.0);
  }
  // Without a field nothing can swing: a pen that is lifted is not held back for what happened on the paper.
  const bool is_free = norm(field) == 0.0 && norm(wanted_) == 0.0;
  free_for_ = is_free ? free_for_ + period_ : 0.0;
  if (free_for_ > longest_flight) surplus_in_plane_ = surplus_normal_ = 0.0;
  wanted_ = field;
  const Eigen::Vector3d force = wanted + damping_;
  return std::isfinite(budget_) ? within_budget(force, viscous + damping_) : force;
}

/// The pen is where this sample says: observes and damps the step to it.
void PassivityController::move(const Eigen::Vector3d& position, const Eigen::Vector3d& wanted) noexcept {
  const Eigen::Vector3d step = has_position_ ? Eigen::Vector3d(position - position_) : Eigen::Vector3d(0.0, 0.0, 0.0);
  const double way = norm(step), seconds = static_cast<double>(unseen_ + 1) * period_;
  const Eigen::Vector3d at_work = force_at_work();
  const bool jumped = way > fastest_pen * scale_ * seconds;
  if (!has_position_) {
    // Without a first position nothing is known of the work: the force was zero then, or is charged from now on.
  } else if (jumped) {
    pay((unseen_force_ + norm(at_work)) * std::max(hand_speed_, speed_) * period_);  // did not move there
  } else if (unseen_ == 0) {
    pay(dot(at_work, step));
    const Eigen::Vector3d beyond = at_work - 0.5 * (wanted_ + wanted);
    surplus_in_plane_ = std::max(0.0, surplus_in_plane_ + beyond.head<2>().dot(step.head<2>()));
    surplus_normal_ = std::max(0.0, surplus_normal_ + beyond.z() * step.z());
  } else {
    // Exact if the force was held; otherwise it is unknown how far the pen moved under which.
    const double speed = std::max({hand_speed_, speed_, way / seconds});
    const double change = unseen_change_ + norm(Eigen::Vector3d(at_work - held_));
    pay(std::min(dot(held_, step) + change * speed * period_, (unseen_force_ + norm(at_work)) * speed * period_));
  }
  const bool seen = has_position_ && !jumped && unseen_ == 0;
  speed_ = has_position_ && !jumped ? way / seconds : 0.0;
  has_position_ = true;
  position_ = position;
  unseen_ = 0;
  unseen_force_ = unseen_change_ = 0.0;
  if (!seen) return;
  const double in_plane = damping_for(surplus_in_plane_, step.head<2>().squaredNorm(), period_, max_damping_);
  const double normal = damping_for(surplus_normal_, step.z() * step.z(), period_, max_damping_);
  damping_.head<2>() = -in_plane / period_ * step.head<2>();
  damping_.z() = -normal / period_ * step.z();
  velocity_ = step / period_;
}

/// A period passes at whose end the position is not known; the force was this one up to a `change` [N].
void PassivityController::pass_unseen(double change) noexcept {
  velocity_.setZero();
  if (!has_position_) return;
  const Eigen::Vector3d& force = force_at_work();
  if (unseen_ == 0) held_ = force;
  ++unseen_;
  unseen_force_ += norm(force);
  unseen_change_ += norm(Eigen::Vector3d(force - held_)) + change;
}

/// When the budget is nearly exhausted, a moving pen is braked lightly, so that it returns energy. Otherwise an
/// exhausted budget would stay exhausted forever, because zero force does no work.
Eigen::Vector3d PassivityController::within_budget(const Eigen::Vector3d& force,
                                                   const Eigen::Vector3d& viscous) noexcept {
  max_force_ = max_payable_force();
  if (max_force_ < brake_) {
    max_force_ = brake_ * (left_ > faintest_share * reserve_ ? std::min(left_ / reserve_, 1.0) : faintest_share);
    return -max_force_ / (norm(velocity_) + slow_pen * scale_) * velocity_;
  }
  if (!(norm(force) > max_force_)) return force;
  const Eigen::Vector3d kept = shortened(viscous, viscous_share * max_force_);
  return shortened(force - viscous, max_force_ - norm(kept)) + kept;
}

void PassivityController::pay(double energy) noexcept {
  given_ += energy;
  left_ = std::min(budget_, left_ - energy);
}

/// Maximum F with F v t + (F t)^2 / (2 m) <= E, where E is what remains after the forces whose work no sample has shown
/// yet, and after the reserve of the brake. While samples are missing, the gap foreseen for this force shrinks by what
/// has passed of it.
double PassivityController::max_payable_force() const noexcept {
  const double speed = std::max(hand_speed_, speed_);
  double remaining = left_ - reserve_ - unseen_force_ * speed * period_;
  for (std::size_t age = 0; age < delay_; ++age) {
    remaining -= norm(sent_[(newest_ + sent_.size() - age) % sent_.size()]) * speed * period_;
  }
  if (!(remaining > 0.0)) return 0.0;
  const double time = std::max(max_gap_ - static_cast<double>(unseen_) * period_, period_) + period_;
  const double way = speed * time, accelerated = 0.5 * time * time / mass_;
  return 2.0 * remaining / (way + std::sqrt(way * way + 4.0 * accelerated * remaining));
}

void PassivityController::sent(const Eigen::Vector3d& force) noexcept {
  newest_ = (newest_ + 1) % sent_.size();
  sent_[newest_] = force;
}

}  // namespace calligraphy
