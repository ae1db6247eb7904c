#include <calligraphy/render/passivity_controller.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

#include <calligraphy/base/error.hpp>

namespace calligraphy {
namespace {

/// What a hand may add to its speed while a force is taken away [m/s].
constexpr double sudden_speed = 0.25;

/// A sample that is further from the last one is not of a pen that went there [m/s].
constexpr double fastest_pen = 10.0;

constexpr double empty_share = 1e-3;     ///< of the budget
constexpr double strongest_brake = 0.1;  ///< with an empty budget [N]
constexpr double slow_pen = 0.01;        ///< braked by half of it [m/s]

void require(bool in_domain, const char* name, double value, const char* domain) {
  if (in_domain) return;
  std::ostringstream message;
  message << "passivity: " << name << " = " << value << ": expected " << domain;
  throw ValueError(message.str());
}

/// Damping that takes `surplus` [J] out of a motion of `step` [m] a period, the step by step [m^2] [N s/m].
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
  require(std::isfinite(max_damping_) && max_damping_ >= 0.0, "max_damping", max_damping_, "a finite number from 0 up");
  require(budget_ >= 0.0, "energy_budget", budget_, "a number from 0 up");
  require(force_rate_ > 0.0, "force_rate", force_rate_, "a number above 0");
  require(std::isfinite(period) && period > 0.0, "period", period, "a finite number above 0");
  require(options.delay >= 0 && options.delay <= longest_delay, "delay", options.delay, "0 to 15 ticks");
  restart();
}

void PassivityController::restart() noexcept {
  sent_.fill(Eigen::Vector3d::Zero());
  has_position_ = false;
  wanted_ = damping_ = velocity_ = Eigen::Vector3d::Zero();
  lost_ = 0;
  speed_ = presumed_way_ = force_while_lost_ = surplus_in_plane_ = surplus_normal_ = given_ = 0.0;
  longest_ = std::numeric_limits<double>::infinity();
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
    if (step.norm() > fastest_pen * period_) {
      pay(force_at_work().norm() * (speed_ + sudden_speed) * period_);  // it is elsewhere; it did not go there
      step.setZero();
    } else if (has_position_) {
      observe(step, wanted);
    }
    has_position_ = true;
    position_ = position;
    velocity_ = step / period_;
    speed_ = velocity_.norm();
    const double in_plane = damping_for(surplus_in_plane_, step.head<2>().squaredNorm(), period_, max_damping_);
    const double normal = damping_for(surplus_normal_, step.z() * step.z(), period_, max_damping_);
    damping_.head<2>() = -in_plane / period_ * step.head<2>();
    damping_.z() = -normal / period_ * step.z();
  }
  wanted_ = wanted;
  const Eigen::Vector3d force = wanted + damping_;
  return std::isfinite(budget_) ? within_budget(force) : force;
}

/// With next to nothing left, or less, as when lost samples were paid for, a pen that moves is braked lightly: it pays
/// back. Without that an empty budget would stay empty for ever, as no force does no work.
Eigen::Vector3d PassivityController::within_budget(const Eigen::Vector3d& force) noexcept {
  longest_ = longest_payable(speed_ + sudden_speed);
  if (left_ < empty_share * budget_) {
    longest_ = left_ > 0.0 ? std::min(longest_, strongest_brake) : strongest_brake;
    return -longest_ / (speed_ + slow_pen) * velocity_;
  }
  const double size = force.norm();
  return size > longest_ ? Eigen::Vector3d(force * (longest_ / size)) : force;
}

/// Where the pen went is not known: pay for one that keeps its speed, and some more, along the force.
void PassivityController::presume() noexcept {
  velocity_.setZero();
  const double way = (speed_ + sudden_speed) * period_;
  const double force = force_at_work().norm();
  pay(force * way);
  presumed_way_ += way;
  force_while_lost_ = std::max(force_while_lost_, force);
  ++lost_;
}

/// The period that ends with this sample is not known either. A pen that went further than presumed is believed as far
/// again: beyond that it was taken elsewhere, or the sample lies.
void PassivityController::find_again(const Eigen::Vector3d& position) noexcept {
  presume();
  const double way = has_position_ ? (position - position_).norm() : 0.0;
  pay(force_while_lost_ * std::clamp(way - presumed_way_, 0.0, presumed_way_));
  speed_ = std::min(way / (static_cast<double>(lost_) * period_), fastest_pen);
  has_position_ = true;
  position_ = position;
  lost_ = 0;
  presumed_way_ = force_while_lost_ = 0.0;
}

void PassivityController::observe(const Eigen::Vector3d& step, const Eigen::Vector3d& wanted) noexcept {
  const Eigen::Vector3d& at_work = force_at_work();
  pay(at_work.dot(step));
  const Eigen::Vector3d beyond = at_work - 0.5 * (wanted_ + wanted);
  surplus_in_plane_ = std::max(0.0, surplus_in_plane_ + beyond.head<2>().dot(step.head<2>()));
  surplus_normal_ = std::max(0.0, surplus_normal_ + beyond.z() * step.z());
}

void PassivityController::pay(double energy) noexcept {
  given_ += energy;
  left_ = std::min(budget_, left_ - energy);
}

/// Largest F with F^2 v / (2 rate) + F v T <= E, where E is what remains after forces sent whose work no sample has
/// shown yet.
double PassivityController::longest_payable(double speed) const noexcept {
  const double way = speed * period_;
  double remaining = left_;
  for (std::size_t age = 0; age < delay_; ++age) {
    remaining -= sent_[(newest_ + sent_.size() - age) % sent_.size()].norm() * way;
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
