// What work a force has done on a pen, from delayed, lost and late samples.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

#include <calligraphy/render/passivity_options.hpp>

namespace calligraphy {

/// From the sample before to this one.
struct ObservedStep {
  bool seen = false;                                ///< one period, at whose ends the position is known
  Eigen::Vector3d way = Eigen::Vector3d::Zero();    ///< [m]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< at work in this period [N]
  double energy = 0.0;                              ///< delivered; an upper bound where the step was not seen [J]
};

/// The observer of PassivityController. Never allocates.
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
  EnergyObserver(const PassivityOptions& options, double period) noexcept;

  /// As PassivityController::acted().
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

  PassivityOptions options_;
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

}  // namespace calligraphy
