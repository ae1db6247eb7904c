// A guidance force that is withdrawn in time, so that a hand that pulls against it is not thrown.
#pragma once

#include <algorithm>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// A spring and a damper along the force that was at work, which never exceed it and never push the other way: a pen
/// that nobody holds is not driven on, and a hand that has been let go of finds less and less.
class ReleasedSpring {
 public:
  void clear() noexcept { *this = {}; }

  /// Takes over `force` [N] on a pen at `tip` [m] with `velocity` [m/s], as a spring of `stiffness` [N/m] with
  /// `damping` [N s/m], and withdraws it in `ticks`.
  void take_over(const Point& force, const Point& tip, const Point& velocity, double stiffness, double damping,
                 double ticks) noexcept {
    size_ = force.norm();
    direction_ = size_ > 0.0 ? Point(force / size_) : Point(Point::Zero());
    stiffness_ = stiffness;
    damping_ = damping;
    unstrained_ = size_ + direction_.dot(stiffness * tip + damping * velocity);
    step_ = ticks > 1.0 ? 1.0 / ticks : 1.0;
    passed_ = 0.0;
  }

  /// Force of the next tick [N].
  Point next(const Point& tip, const Point& velocity) noexcept {
    if (size_ == 0.0) return Point::Zero();
    passed_ = std::min(1.0, passed_ + step_);
    const double left = 1.0 - passed_ * passed_ * (3.0 - 2.0 * passed_);
    const double force = unstrained_ - direction_.dot(stiffness_ * tip + damping_ * velocity);
    const double size = size_;
    if (passed_ == 1.0) size_ = 0.0;
    return left * std::clamp(force, 0.0, size) * direction_;
  }

 private:
  double size_ = 0.0;  ///< most that it may be [N]; 0: none
  Point direction_ = Point::Zero();
  double unstrained_ = 0.0;  ///< force at a pen at rest in the origin [N]
  double stiffness_ = 0.0, damping_ = 0.0;
  double step_ = 1.0, passed_ = 0.0;  ///< share of the time
};

}  // namespace calligraphy
