// Passivity observer and controller on the force really sent.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include <Eigen/Core>

namespace calligraphy {

struct PassivityOptions {
  double max_damping = 0.0;  ///< largest damping injected; 0: no control [N s/m]
  /// Net energy that may be given to the hand from the start on: the start-up budget. Infinite: any [J].
  double energy_budget = std::numeric_limits<double>::infinity();
  /// With a budget: how fast the last stage takes a force away [N/s]. Infinite: at once.
  double force_rate = std::numeric_limits<double>::infinity();
  int delay = 0;  ///< age of a sample when it is read, at most PassivityController::max_delay [ticks]
};

/// Keeps a sampled force law from giving out energy that it does not have.
///
/// Observer: the force held over a period does the work F(n-1) . (x(n) - x(n-1)), exactly (Ryu, Preusche, Hannaford and
/// Hirzinger 2005, after Hannaford and Ryu 2002). F is the force sent after every limit, and with delayed samples the
/// one that was at work when they were taken.
///
/// Controller: over the same step the wanted force field does (W(n-1) + W(n)) / 2 . (x(n) - x(n-1)), exactly for a
/// spring. What the held force gives beyond it is made by sampling, delay, limits and encoder; it is the field's stored
/// energy that serves as the reference, not zero as in the first paper, so that a pen that leans on the paper has no
/// credit to vibrate on. The surplus is damped out of the motion in the next periods, the paper's plane and its normal
/// (z) apart: alpha = surplus / (T v^2), at most max_damping. For a spring alone alpha is K T / 2, Colgate's bound. A
/// deficit, energy dissipated, is forgotten: it is no credit.
///
/// Budget: with E of the budget left, a force is shortened to what can be taken away at force_rate before a pen at its
/// present speed (and 0.25 m/s more) has used up E. Energy that the hand gives flows back into E, up to the budget.
/// With less than a thousandth of it left, or overdrawn, as lost samples are paid for generously, a brake of at most
/// 0.1 N against the motion is all that remains, so that the pen pays back. The true work never exceeds the budget,
/// whatever the field, as long as
/// - a limit behind, if there is one, keeps a force within max_force(), and one that is longer falls by
///   force_rate x period in every tick (ForceLimiter::next does so with that as `max_length`);
/// - the pen is never faster than 0.25 m/s above its speed at the last tick whose force was within max_force(),
///   until that force is taken away: |F| / force_rate + delay + 1 ticks. A pen that is faster by u may be given
///   |F| u times that time more;
/// - each sample is `delay` ticks old, or known to be lost, or more than 10 m/s away (then the pen is elsewhere and is
///   presumed to have kept its speed); of an encoder of step D at most D / 2 times the sum of all changes of the force
///   is not seen.
class PassivityController {
 public:
  static constexpr int max_delay = 15;

  /// The damping at which a mass of the device, alone, is still damped and not thrown back within one period,
  /// 0.9 m / (T (1 + 2 delay)) [N s/m].
  static double usable_damping(double mass, double period, int delay) noexcept;

  PassivityController() = default;
  /// @throws ValueError naming the value when an option or the period is out of its domain
  PassivityController(const PassivityOptions& options, double period);

  /// The force to be sent for a wanted one [N], at the device's position of this tick [m]; limits may follow. With
  /// NaN in the position, the sample of this tick is lost: nothing is damped, and the pen is presumed to go on along
  /// the force.
  Eigen::Vector3d next(const Eigen::Vector3d& position, const Eigen::Vector3d& wanted) noexcept;
  /// The force that came out of the limits and holds from now on. Call it once after every next().
  void sent(const Eigen::Vector3d& force) noexcept;
  /// Nothing sent, nothing given.
  void restart() noexcept;

  /// Net energy given to the hand, as observed [J].
  double energy_given() const noexcept { return given_; }
  /// What is left of the budget [J].
  double energy_remaining() const noexcept { return left_; }
  /// What the last next() shortened to; infinite without a budget [N].
  double max_force() const noexcept { return max_force_; }
  /// Injected in the last tick [N].
  const Eigen::Vector3d& damping() const noexcept { return damping_; }

 private:
  const Eigen::Vector3d& force_at_work() const noexcept {
    return sent_[(newest_ + sent_.size() - delay_) % sent_.size()];
  }
  Eigen::Vector3d within_budget(const Eigen::Vector3d& force) noexcept;
  void observe(const Eigen::Vector3d& step, const Eigen::Vector3d& wanted) noexcept;
  void pay(double energy) noexcept;
  void presume() noexcept;
  void find_again(const Eigen::Vector3d& position) noexcept;
  double max_payable_force(double speed) const noexcept;

  double max_damping_ = 0.0;
  double budget_ = std::numeric_limits<double>::infinity();
  double force_rate_ = std::numeric_limits<double>::infinity();
  double period_ = 0.001;
  std::size_t delay_ = 0;

  std::array<Eigen::Vector3d, max_delay + 1> sent_ = {};  ///< ring
  std::size_t newest_ = 0;
  bool has_position_ = false;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d wanted_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d damping_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();  ///< over the last period; zero while lost [m/s]
  double speed_ = 0.0;                                  ///< as last known [m/s]
  int lost_ = 0;                                        ///< ticks since the last position
  double presumed_way_ = 0.0;                           ///< of those [m]
  double force_while_lost_ = 0.0;                       ///< the largest at work in those [N]
  double max_force_ = std::numeric_limits<double>::infinity();
  double surplus_in_plane_ = 0.0;  ///< not yet damped out [J]
  double surplus_normal_ = 0.0;    ///< [J]
  double given_ = 0.0;
  double left_ = std::numeric_limits<double>::infinity();
};

}  // namespace calligraphy
