// A budget for the energy that the force at work delivers to the hand.
#pragma once

#include <limits>

#include <Eigen/Core>

#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/render/detail/energy_observer.hpp>

namespace calligraphy {

/// Budget of everything(), and of a law about which nothing is known [J].
inline constexpr double usual_energy_budget = 0.1;

/// Whether energy can be accounted for: the device's mass is known, and its samples are not too old.
inline bool permits_account(const Capabilities& device) noexcept {
  return device.apparent_mass > 0.0 && device.sample_delay <= detail::EnergyObserver::max_delay;
}

/// How much energy may be given, and what a budget must know about the device, the hand and the loop.
struct EnergyBudgetOptions {
  /// Maximum net energy delivered to the hand since the start. Infinite: no limit [J].
  double budget = std::numeric_limits<double>::infinity();
  double mass = std::numeric_limits<double>::infinity();  ///< of the device alone, the lightest pen [kg]
  double encoder_step = 0.0;                              ///< resolution of a position along each axis [m]
  /// Always charge the most that the force may give unseen by following motion that the encoder hides.
  bool charges_encoder = false;
  detail::EnergyObserverOptions observer = {};  ///< which accounts for the energy
};

/// Limits the force so that its net energy, as EnergyObserver accounts for it, stays within a budget. Never allocates.
///
/// With E of the budget left, a force is limited to what cannot use up E before the next sample is known:
/// F v t + (F t)^2 / (2 m) <= E, with v = hand_speed, or the pen's own speed if that is higher, and t = max_gap plus a
/// period: the path of a pen that the hand moves at v while the force accelerates it for that time. Forces whose work
/// no sample has shown yet are charged likewise. Energy that the hand returns is added to E, up to the budget. Where
/// this rule leaves less than 0.1 N, the force becomes a brake against the motion (a weaker one with samples older than
/// 10 ms), so that the pen returns energy. The brake is paid from a reserve by the same rule: it fades with the reserve
/// where late samples make it push, and grows with it where it brakes. What a violation of the conditions below
/// overdraws is repaid before more is given. The true net energy never exceeds the budget, whatever the field, while
/// - no downstream stage lengthens a force, and one that changes a force reports it (acted());
/// - no hand moves the pen faster than `hand_speed`, and no gap is longer than `max_gap`: a longer one of t seconds may
///   deliver |F| v t, which is repaid before more is given;
/// - each sample is `delay` ticks old, or known to be lost, or more than 10 m/s away (then the pen is elsewhere).
/// What stays unobserved is, with an encoder of resolution D, at most D / 2 times the sum of all changes of the force,
/// and, within a period in which the force changes, what a pen of acceleration a moves off a straight line: at most
/// a T^2 / 8 times that sum.
class EnergyBudget {
 public:
  EnergyBudget() = default;
  /// @throws ValueError naming the value when an option or the period is out of range
  EnergyBudget(const EnergyBudgetOptions& options, double period);

  /// Reports, before next(), the force that acts at this sample [N], and the ticks that have passed since the last
  /// call: more than one when the loop paused. For the first `settling` [s] of them another force may have acted. In a
  /// single tick, that was the force of the last call, and the work is divided in proportion to time. Over a pause it
  /// may have been any force between this one and those before, for at least `max_gap`. Without a call it was the force
  /// of sent(), for one tick.
  void acted(const Eigen::Vector3d& force, int ticks, double settling = 0.0) noexcept {
    observer_.acted(force, ticks, settling);
  }
  /// The force to send for a desired one [N], at the device position of this tick [m]; limits may follow. A position
  /// with NaN means that the sample of this tick is lost or stale. `viscous` is the part of `wanted` that opposes the
  /// motion: where the budget limits the force, some of it remains, since a force that depends on the energy alone
  /// would let the pen swing.
  Eigen::Vector3d next(const Eigen::Vector3d& position, const Eigen::Vector3d& wanted,
                       const Eigen::Vector3d& viscous = Eigen::Vector3d::Zero()) noexcept;
  /// Reports the force after all limits, held from now on. Call it once after every next().
  void sent(const Eigen::Vector3d& force) noexcept;
  /// Refills the budget by energy that may be given in addition to it [J].
  void earn(double energy) noexcept { spend(-energy); }
  /// Resets: no force sent, no energy delivered.
  void restart() noexcept;

  /// Net energy delivered to the hand, as observed; work not yet observed is not in it [J].
  double energy_given() const noexcept { return observer_.energy_given(); }
  /// Force limit of the last next(); infinite without a budget [N].
  double max_force() const noexcept { return max_force_; }

 private:
  Eigen::Vector3d limited(const Eigen::Vector3d& force, const Eigen::Vector3d& viscous) noexcept;
  double payable_force(double energy) const noexcept;
  void spend(double energy) noexcept;

  EnergyBudgetOptions options_;
  double period_ = 0.001;  ///< [s]
  detail::EnergyObserver observer_;
  double smoothing_ = 1.0;                               ///< share of a period in the average of the velocity
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();  ///< of the pen, smoothed for the brake [m/s]
  bool brakes_ = false;
  double brake_ = 0.1;    ///< with an exhausted budget [N]
  double reserve_ = 0.0;  ///< for the brake [J]
  double remaining_ = std::numeric_limits<double>::infinity();
  double owed_ = 0.0;  ///< overdrawn, and not repaid yet [J]
  double max_force_ = std::numeric_limits<double>::infinity();
};

}  // namespace calligraphy
