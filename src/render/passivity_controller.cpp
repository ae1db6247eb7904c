#include <calligraphy/render/passivity_controller.hpp>

#include <algorithm>
#include <cmath>

#include "base/require.hpp"

#include "collision/length.hpp"

namespace calligraphy {
namespace {

/// How much a pen may speed up while a force is being removed [m/s].
constexpr double sudden_speed = 0.25;

/// A sample that implies a faster pen is not a motion: the pen is elsewhere [m/s].
constexpr double fastest_pen = 10.0;

constexpr double empty_share = 1e-3;     ///< of the budget
constexpr double strongest_brake = 0.1;  ///< with an exhausted budget [N]
constexpr double slow_pen = 0.01;        ///< speed at which half of the brake acts [m/s]

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
      force_rate_(options.force_rate),
      period_(period),
      delay_(static_cast<std::size_t>(std::max(0, options.delay))) {
  require_not_negative("passivity: max_damping", max_damping_, "N s/m");
  require(budget_ >= 0.0, "passivity: energy_budget", budget_, "J", "at least 0");
  require(force_rate_ > 0.0, "passivity: force_rate", force_rate_, "N/s", "above 0");
  require_above_zero("passivity: period", period, "s");
  require_within("passivity: delay", options.delay, "ticks", 0, max_delay);
  restart();
}

void PassivityController::restart() noexcept {
  sent_.fill(Eigen::Vector3d::Zero());
  has_position_ = false;
  wanted_ = damping_ = velocity_ = Eigen::Vector3d::Zero();
  lost_ = 0;
  speed_ = presumed_way_ = force_while_lost_ = surplus_in_plane_ = surplus_normal_ = given_ = 0.0;
  max_force_ = std::numeric_limits<double>::infinity();
  left_ = budget_;
}

Eigen::Vector3d PassivityController::next(const Eigen::Vector3d& position, const Eigen::Vector3d& wanted) noexcept {
  damping_.setZero();
  if (!position.allFinite()) {
    presume();
  } else if (lost_ > 0) {
    find_again(position);
  } else {
    Eigen::Vector3d step = has_position_ ? Eigen::Vector3d(position - position_) : Eigen::Vector3d(0.0, 0.0, 0.0);
    if (norm(step) > fastest_pen * period_) {
      pay(norm(force_at_work()) * (speed_ + sudden_speed) * period_);  // it is elsewhere, but did not move there
      step.setZero();
    } else if (has_position_) {
      observe(step, wanted);
    }
    has_position_ = true;
    position_ = position;
    velocity_ = step / period_;
    speed_ = norm(velocity_);
    const double in_plane = damping_for(surplus_in_plane_, step.head<2>().squaredNorm(), period_, max_damping_);
    const double normal = damping_for(surplus_normal_, step.z() * step.z(), period_, max_damping_);
    damping_.head<2>() = -in_plane / period_ * step.head<2>();
    damping_.z() = -normal / period_ * step.z();
  }
  wanted_ = wanted;
  const Eigen::Vector3d force = wanted + damping_;
  return std::isfinite(budget_) ? within_budget(force) : force;
}

/// When the budget is nearly exhausted, or overdrawn because lost samples were charged, a moving pen is braked lightly,
/// so that it returns energy. Otherwise an exhausted budget would stay exhausted forever, because zero force does no
/// work.
Eigen::Vector3d PassivityController::within_budget(const Eigen::Vector3d& force) noexcept {
  max_force_ = max_payable_force(speed_ + sudden_speed);
  if (left_ < empty_share * budget_) {
    max_force_ = left_ > 0.0 ? std::min(max_force_, strongest_brake) : strongest_brake;
    return -max_force_ / (speed_ + slow_pen) * velocity_;
  }
  const double size = norm(force);
  return size > max_force_ ? Eigen::Vector3d(force * (max_force_ / size)) : force;
}

/// The motion of the pen is unknown: charge for one that keeps its speed, and some more, along the force.
void PassivityController::presume() noexcept {
  velocity_.setZero();
  const double way = (speed_ + sudden_speed) * period_;
  const double force = norm(force_at_work());
  pay(force * way);
  presumed_way_ += way;
  force_while_lost_ = std::max(force_while_lost_, force);
  ++lost_;
}

/// The period that ends with this sample is unknown too. A pen that moved farther than presumed is charged for up to
/// twice the presumed path: beyond that it was moved elsewhere, or the sample is wrong.
void PassivityController::find_again(const Eigen::Vector3d& position) noexcept {
  presume();
  const double way = has_position_ ? norm(position - position_) : 0.0;
  pay(force_while_lost_ * std::clamp(way - presumed_way_, 0.0, presumed_way_));
  speed_ = std::min(way / (static_cast<double>(lost_) * period_), fastest_pen);
  has_position_ = true;
  position_ = position;
  lost_ = 0;
  presumed_way_ = force_while_lost_ = 0.0;
}

void PassivityController::observe(const Eigen::Vector3d& step, const Eigen::Vector3d& wanted) noexcept {
  const Eigen::Vector3d& at_work = force_at_work();
  pay(dot(at_work, step));
  const Eigen::Vector3d beyond = at_work - 0.5 * (wanted_ + wanted);
  surplus_in_plane_ = std::max(0.0, surplus_in_plane_ + beyond.head<2>().dot(step.head<2>()));
  surplus_normal_ = std::max(0.0, surplus_normal_ + beyond.z() * step.z());
}

void PassivityController::pay(double energy) noexcept {
  given_ += energy;
  left_ = std::min(budget_, left_ - energy);
}

/// Maximum F with F^2 v / (2 rate) + F v T <= E, where E is what remains after the forces sent whose work no sample has
/// shown yet.
double PassivityController::max_payable_force(double speed) const noexcept {
  const double way = speed * period_;
  double remaining = left_;
  for (std::size_t age = 0; age < delay_; ++age) {
    remaining -= norm(sent_[(newest_ + sent_.size() - age) % sent_.size()]) * way;
  }
  if (!(remaining > 0.0)) return 0.0;
  const double braking = 0.5 * speed / force_rate_;
  return 2.0 * remaining / (way + std::sqrt(way * way + 4.0 * braking * remaining));
}

void PassivityController::sent(const Eigen::Vector3d& force) noexcept {
  newest_ = (newest_ + 1) % sent_.size();
  sent_[newest_] = force;
}

}  // namespace calligraphy
