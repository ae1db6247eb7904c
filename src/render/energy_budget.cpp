#include <calligraphy/render/detail/energy_budget.hpp>

#include <algorithm>
#include <cmath>

#include "collision/length.hpp"

namespace calligraphy {
namespace {

constexpr double max_brake = 0.1;          ///< with an exhausted budget [N]
constexpr double min_brake_share = 0.2;    ///< of the brake with an overdrawn budget
constexpr double max_brake_age = 0.01;     ///< an older velocity says less, and brakes less [s]
constexpr double half_brake_speed = 0.01;  ///< of the pen, at which half of the brake acts [m/s]

constexpr double damping_share = 0.15;  ///< of a force that the budget limits

}  // namespace

EnergyBudget::EnergyBudget(const PassivityOptions& options, double period) noexcept
    : options_(options), period_(period) {
  brake_ = max_brake / options.scale * std::min(1.0, max_brake_age / ((options.delay + 1.0) * period));
  reserve_ = std::min(0.5 * options.energy_budget, brake_ * options.hand_speed * (options.max_gap + period));
  restart();
}

void EnergyBudget::restart() noexcept {
  remaining_ = options_.energy_budget;
  max_force_ = std::numeric_limits<double>::infinity();
}

/// When the budget is nearly exhausted, a moving pen is braked lightly, so that it returns energy. Otherwise an
/// exhausted budget would stay exhausted forever, because zero force does no work.
Eigen::Vector3d EnergyBudget::limited(const Eigen::Vector3d& force, const Eigen::Vector3d& viscous,
                                      const EnergyObserver& observer) noexcept {
  max_force_ = payable_force(observer);
  if (max_force_ < brake_) {
    const bool is_overdrawn = !(remaining_ > min_brake_share * reserve_);
    max_force_ = brake_ * (is_overdrawn ? min_brake_share : std::min(remaining_ / reserve_, 1.0));
    const Eigen::Vector3d& velocity = observer.velocity();
    return -max_force_ / (norm(velocity) + half_brake_speed * options_.scale) * velocity;
  }
  if (!(dot(force, force) > max_force_ * max_force_)) return force;
  const Eigen::Vector3d kept = shortened(viscous, damping_share * max_force_);
  return shortened(force - viscous, max_force_ - norm(kept)) + kept;
}

/// Maximum F with F v t + (F t)^2 / (2 m) <= E, where E is what remains after the forces whose work no sample has shown
/// yet, and after the reserve of the brake. While samples are missing, the gap foreseen for this force shrinks by what
/// has passed of it.
double EnergyBudget::payable_force(const EnergyObserver& observer) const noexcept {
  const double speed = observer.speed();
  double available = remaining_ - reserve_ - observer.gap().force * speed * period_;
  for (int age = 0; age < observer.delay(); ++age) {
    available -= norm(observer.sent_before(static_cast<std::size_t>(age))) * speed * period_;
  }
  if (!(available > 0.0)) return 0.0;
  const double passed = static_cast<double>(observer.gap().periods) * period_;
  const double time = std::max(options_.max_gap - passed, period_) + period_;
  const double way = speed * time, accelerated = 0.5 * time * time / options_.mass;
  return 2.0 * available / (way + std::sqrt(way * way + 4.0 * accelerated * available));
}

}  // namespace calligraphy
