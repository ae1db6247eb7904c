// What work a force has done on a pen, from delayed, lost and late samples.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

namespace calligraphy::detail {

/// What an observer must know of the hand and the loop.
struct EnergyObserverOptions {
  double hand_speed = 2.0;  ///< maximum speed at which a hand moves the pen [m/s]
  double max_gap = 0.016;   ///< longest time for which a force is held without a fresh sample [s]
  double scale = 1.0;       ///< K_S (MotionMapping): forces are 1 / scale, speeds scale times those of the device
  int delay = 0;            ///< age of a sample when it is read, at most EnergyObserver::max_delay [ticks]
};

/// From the sample before to this one.
struct ObservedStep {
  bool seen = false;                                ///< one period, at whose ends the position is known
  Eigen::Vector3d way = Eigen::Vector3d::Zero();    ///< [m]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< at work in this period [N]
  double energy = 0.0;                              ///< delivered; an upper bound where the step was not seen [J]
};

/// The force held over a period does the work F(n-1) . (x(n) - x(n-1)), exactly (Ryu, Preusche, Hannaford and Hirzinger
/// 2005, after Hannaford and Ryu 2002). F is the force at work, after all limits, guards and ramps; with delayed
/// samples, the force that acted when they were taken. EnergyBudget says how far this account is true. Never allocates.
class EnergyObserver {
 public:
  static constexpr int max_delay = 15;

  /// Periods without a known position, the one that ends with the next sample not counted.
  struct Gap {
    std::int64_t periods = 0;
    Eigen::Vector3d held = Eigen::Vector3d::Zero();  ///< force of the first of them [N]
    double force = 0.0;                              ///< sum of |F| over them [N]
    double change = 0.0;                             ///< sum of |F - held| over them [N]
  };

  EnergyObserver() = default;
  EnergyObserver(const EnergyObserverOptions& options, double period) noexcept;

  /// As EnergyBudget::acted().
  void acted(const Eigen::Vector3d& force, int ticks, double settling) noexcept {
    if (ticks > 1) {
      acted_over_pause(force, ticks - 1, settling);
      return;
    }
    sent_[newest_] = force;
    if (settling > 0.0) {  // each force has its share of the time, and so of the way
      sent_[newest_] += std::min(settling / period_, 1.0) * (at_last_sample_ - force);
    }
    at_last_sample_ = force;
  }
  /// The pen is where this sample says [m].
  ObservedStep move(const Eigen::Vector3d& position) noexcept;
  /// A period passes at whose end the position is not known.
  void lose_sample() noexcept { pass_unseen(0.0); }
  void sent(const Eigen::Vector3d& force) noexcept {
    newest_ = (newest_ + 1) % sent_.size();
    sent_[newest_] = force;
  }
  void restart() noexcept;

  double energy_given() const noexcept { return given_; }
  /// Over the last period; zero if that is not known [m/s].
  const Eigen::Vector3d& velocity() const noexcept { return velocity_; }
  /// At which a hand may move the pen: its maximum speed, or the pen's over the last known step if that is higher
  /// [m/s].
  double speed() const noexcept;
  const Gap& gap() const noexcept { return gap_; }
  int delay() const noexcept { return static_cast<int>(delay_); }
  /// The force sent `age` ticks ago [N].
  const Eigen::Vector3d& sent_before(std::size_t age) const noexcept {
    return sent_[(newest_ + sent_.size() - age) % sent_.size()];
  }

 private:
  const Eigen::Vector3d& force_at_work() const noexcept { return sent_before(delay_); }
  void acted_over_pause(const Eigen::Vector3d& force, int missed, double settling) noexcept;
  void move_after_gap(ObservedStep& step) noexcept;
  void pass_unseen(double change) noexcept;
  void pass_unseen(const Eigen::Vector3d& force, int count, double change) noexcept;

  EnergyObserverOptions options_;
  double period_ = 0.001, rate_ = 1000.0;                 ///< [s], [Hz]
  std::size_t delay_ = 0;                                 ///< [ticks]
  std::array<Eigen::Vector3d, max_delay + 1> sent_ = {};  ///< ring buffer
  std::size_t newest_ = 0;
  Eigen::Vector3d at_last_sample_ = Eigen::Vector3d::Zero();  ///< the force then at work [N]
  bool has_position_ = false;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  double speed_ = 0.0;  ///< of the last known step, if that was faster than a hand [m/s]
  Gap gap_;
  double given_ = 0.0;  ///< [J]
};

}  // namespace calligraphy::detail
