// How much force may be sent for what remains of an energy budget.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include <calligraphy/render/detail/energy_observer.hpp>
#include <calligraphy/render/passivity_options.hpp>

namespace calligraphy {

/// The budget of PassivityController. Never allocates.
class EnergyBudget {
 public:
  EnergyBudget() = default;
  EnergyBudget(const PassivityOptions& options, double period) noexcept;

  bool is_limited() const noexcept { return std::isfinite(options_.energy_budget); }
  /// The pen has been given this energy, or has returned it where negative [J].
  void pay(double energy) noexcept { remaining_ = std::min(options_.energy_budget, remaining_ - energy); }
  /// What of `force` may be sent; `viscous` is the part of it that opposes the motion [N].
  Eigen::Vector3d limited(const Eigen::Vector3d& force, const Eigen::Vector3d& viscous,
                          const EnergyObserver& observer) noexcept;
  void restart() noexcept;

  /// Of the last limited(); infinite before that [N].
  double max_force() const noexcept { return max_force_; }

 private:
  double payable_force(const EnergyObserver& observer) const noexcept;

  PassivityOptions options_;
  double period_ = 0.001;  ///< [s]
  double brake_ = 0.1;     ///< with an exhausted budget [N]
  double reserve_ = 0.0;   ///< for the brake [J]
  double remaining_ = std::numeric_limits<double>::infinity();
  double max_force_ = std::numeric_limits<double>::infinity();
};

}  // namespace calligraphy
