#include <calligraphy/experiments/passivity_controller.hpp>

#include <algorithm>

#include "base/require.hpp"
#include "collision/length.hpp"

namespace calligraphy {
namespace {

/// A pen that bounces is back on the paper within this time [s].
constexpr double max_bounce = 0.05;

/// Damping [N s/m] that dissipates `surplus` [J] within one period; `square` is the squared step of that period [m^2].
double damping_for(double surplus, double square, double period, double most) noexcept {
  if (!(square > 0.0)) return 0.0;
  return std::min(surplus * period / square, most);
}

}  // namespace

PassivityController::PassivityController(const PassivityOptions& options, double period)
    : max_damping_(options.max_damping), period_(period), observer_({.delay = options.delay}, period) {
  require_not_negative("passivity: max_damping", options.max_damping, "N s/m");
  require_above_zero("passivity: period", period, "s");
  require_within("passivity: delay", options.delay, "ticks", 0, max_delay);
}

void PassivityController::restart() noexcept {
  observer_.restart();
  field_ = damping_ = Eigen::Vector3d::Zero();
  surplus_in_plane_ = surplus_normal_ = free_for_ = 0.0;
}

Eigen::Vector3d PassivityController::next(const Eigen::Vector3d& position, const Eigen::Vector3d& wanted) noexcept {
  damping_.setZero();
  if (is_finite(position)) {
    const detail::ObservedStep step = observer_.move(position);
    if (step.seen) damp(step, wanted);
  } else {
    observer_.lose_sample();
  }
  // Without a field nothing can swing: a pen that is lifted is not held back for what happened on the paper.
  const bool is_free = dot(wanted, wanted) == 0.0 && dot(field_, field_) == 0.0;
  free_for_ = is_free ? free_for_ + period_ : 0.0;
  if (free_for_ > max_bounce) surplus_in_plane_ = surplus_normal_ = 0.0;
  field_ = wanted;
  return wanted + damping_;
}

/// Damps the motion of this step, for the energy delivered beyond the work of the field.
void PassivityController::damp(const detail::ObservedStep& step, const Eigen::Vector3d& field) noexcept {
  const Eigen::Vector3d beyond = step.force - 0.5 * (field_ + field);
  surplus_in_plane_ = std::max(0.0, surplus_in_plane_ + beyond.head<2>().dot(step.way.head<2>()));
  surplus_normal_ = std::max(0.0, surplus_normal_ + beyond.z() * step.way.z());
  if (surplus_in_plane_ > 0.0) {
    const double in_plane = damping_for(surplus_in_plane_, step.way.head<2>().squaredNorm(), period_, max_damping_);
    damping_.head<2>() = -in_plane / period_ * step.way.head<2>();
  }
  if (surplus_normal_ > 0.0) {
    const double normal = damping_for(surplus_normal_, step.way.z() * step.way.z(), period_, max_damping_);
    damping_.z() = -normal / period_ * step.way.z();
  }
}

}  // namespace calligraphy
