// A guidance force that is withdrawn gradually, so that a hand that pulls against it is not thrown.
#pragma once

#include <algorithm>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// Rises from 0 to 1 with `share`, without slope at either end.
inline double smooth_step(double share) noexcept { return share * share * (3.0 - 2.0 * share); }

/// A spring and a damper along the force that was at work: the spring only slackens and never pushes the other way, and
/// vanishes before the damper does. A hand that is let go of feels less and less, and a pen that nobody holds is not
/// driven on.
class ReleasedSpring {
 public:
  void clear() noexcept { *this = {}; }

  /// Takes over `force` [N] on a pen at `tip` [m] with `velocity` [m/s], as a spring of `stiffness` [N/m] with
  /// `damping` [N s/m], and withdraws it in `ticks`.
  void take_over(const Point& force, const Point& tip, const Point& velocity, double stiffness, double damping,
                 double ticks) noexcept {
    const double size = force.norm();
    direction_ = size > 0.0 ? Point(force / size) : Point(Point::Zero());
    stiffness_ = stiffness;
    damping_ = damping;
    tip_ = tip;
    strained_ = std::max(0.0, size + damping * direction_.dot(velocity));
    step_ = ticks > 1.0 ? 1.0 / ticks : 1.0;
    passed_ = 0.0;
    acts_ = size > 0.0;
  }

  bool acts() const noexcept { return acts_; }

  /// Force of the next tick [N].
  Point next(const Point& tip, const Point& velocity) noexcept {
    if (!acts_) return Point::Zero();
    passed_ = std::min(1.0, passed_ + step_);
    acts_ = passed_ < 1.0;
    const double left = 1.0 - smooth_step(passed_);
    const double spring = std::clamp(strained_ - stiffness_ * direction_.dot(tip - tip_), 0.0, strained_);
    const double damping = (1.0 - passed_ * passed_ * passed_) * damping_ * direction_.dot(velocity);
    return (left * spring - damping) * direction_;
  }

 private:
  bool acts_ = false;
  Point direction_ = Point::Zero();
  Point tip_ = Point::Zero();
  double strained_ = 0.0;  ///< maximum force of the spring [N]
  double stiffness_ = 0.0, damping_ = 0.0;
  double step_ = 1.0, passed_ = 0.0;  ///< share of the time
};

}  // namespace calligraphy
