#include "energy_budget.hpp"

#include <algorithm>
#include <cmath>

#include "base/require.hpp"
#include "collision/length.hpp"

namespace calligraphy {
namespace {

constexpr double max_brake = 0.1;          ///< with an exhausted budget [N]
constexpr double least_share = 1e-9;       ///< of the reserve, with which an overdrawn budget starts to earn
constexpr double max_brake_age = 0.01;     ///< an older velocity says less, and brakes less [s]
constexpr double half_brake_speed = 0.01;  ///< of the pen, at which half of the brake acts [m/s]
constexpr double brake_smoothing = 0.01;   ///< time over which the pen's velocity is averaged for the brake [s]

constexpr double damping_share = 0.15;  ///< of a force that the budget limits

}  // namespace

EnergyBudget::EnergyBudget(const EnergyBudgetOptions& options, double period)
    : options_(options), period_(period), observer_(options.observer, period) {
  const auto& [hand_speed, max_gap, scale, delay] = options.observer;
  require_not_negative("energy budget: encoder_step", options.encoder_step, "m");
  require(options.budget >= 0.0, "energy budget: budget", options.budget, "J", "at least 0");
  require(options.mass > 0.0, "energy budget: mass", options.mass, "kg", "above 0");
  require_above_zero("energy budget: hand_speed", hand_speed, "m/s");
  require_not_negative("energy budget: max_gap", max_gap, "s");
  require_above_zero("energy budget: scale", scale, "");
  require_above_zero("energy budget: period", period, "s");
  require_within("energy budget: delay", delay, "ticks", 0, detail::EnergyObserver::max_delay);
  brake_ = max_brake / scale * std::min(1.0, max_brake_age / ((delay + 1.0) * period));
  reserve_ = std::min(0.5 * options.budget, brake_ * hand_speed * (max_gap + (delay + 1.0) * period));
  smoothing_ = -std::expm1(-period / brake_smoothing);
  restart();
}

void EnergyBudget::restart() noexcept {
  observer_.restart();
  velocity_.setZero();
  brakes_ = false;
  remaining_ = options_.budget;
  owed_ = 0.0;
  max_force_ = std::numeric_limits<double>::infinity();
}

Eigen::Vector3d EnergyBudget::next(const Eigen::Vector3d& position, const Eigen::Vector3d& wanted,
                                   const Eigen::Vector3d& viscous) noexcept {
  if (is_finite(position)) {
    spend(observer_.move(position).energy);
  } else {
    observer_.lose_sample();
  }
  velocity_ += smoothing_ * (observer_.velocity() - velocity_);
  return std::isfinite(options_.budget) ? limited(wanted, viscous) : wanted;
}

/// What was spent beyond the budget is owed: the brake starts from next to nothing, earns its reserve, and then repays.
void EnergyBudget::spend(double energy) noexcept {
  remaining_ -= energy;
  const double least = least_share * reserve_;
  if (remaining_ < least) {
    owed_ += least - remaining_;
    remaining_ = least;
  }
  const double repaid = std::clamp(remaining_ - reserve_, 0.0, owed_);
  owed_ -= repaid;
  remaining_ = std::min(options_.budget, remaining_ - repaid);
}

/// When the budget is nearly exhausted, a moving pen is braked lightly, so that it returns energy. Otherwise an
/// exhausted budget would stay exhausted forever, because zero force does no work. The brake pays in advance too, from
/// the reserve: behind late samples it may push a pen that has turned around. Its velocity is smoothed: the work of a
/// force that changes with the encoder steps is not seen, and so is charged (sent()).
Eigen::Vector3d EnergyBudget::limited(const Eigen::Vector3d& force, const Eigen::Vector3d& viscous) noexcept {
  max_force_ = payable_force(remaining_ - reserve_);
  brakes_ = max_force_ < brake_;
  if (brakes_) {
    max_force_ = std::min(brake_, payable_force(remaining_));
    return -max_force_ / (norm(velocity_) + half_brake_speed * options_.observer.scale) * velocity_;
  }
  if (!(dot(force, force) > max_force_ * max_force_)) return force;
  const Eigen::Vector3d kept = shortened(viscous, damping_share * max_force_);
  return shortened(force - viscous, max_force_ - norm(kept)) + kept;
}

void EnergyBudget::sent(const Eigen::Vector3d& force) noexcept {
  if (brakes_ || options_.charges_encoder) {
    spend(0.5 * options_.encoder_step * (force - observer_.sent_before(0)).cwiseAbs().sum());
  }
  observer_.sent(force);
}

/// Maximum F with F v t + (F t)^2 / (2 m) <= E, where E is what is left of `energy` after the forces whose work no
/// sample has shown yet. While samples are missing, the gap foreseen for this force shrinks by what has passed of it.
double EnergyBudget::payable_force(double energy) const noexcept {
  const double speed = observer_.speed();
  double available = energy - observer_.gap().force * speed * period_;
  for (int age = 0; age < observer_.delay(); ++age) {
    available -= norm(observer_.sent_before(static_cast<std::size_t>(age))) * speed * period_;
  }
  if (!(available > 0.0)) return 0.0;
  const double passed = static_cast<double>(observer_.gap().periods) * period_;
  const double time = std::max(options_.observer.max_gap - passed, period_) + period_;
  const double way = speed * time, accelerated = 0.5 * time * time / options_.mass;
  return 2.0 * available / (way + std::sqrt(way * way + 4.0 * accelerated * available));
}

}  // namespace calligraphy
