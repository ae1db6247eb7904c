#include <calligraphy/render/stiffness_advice.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

namespace calligraphy {
namespace {

using Complex = std::complex<double>;

/// Motion of the mass between samples under a held force, in units of the period T and of the mass: the response
/// after one period to a unit impulse (`speed`) and to a unit force held (`force`).
struct Motion {
  double damping, stiffness;  ///< b T / m, k T^2 / m
  double speed, force;
};

Motion motion_over_a_period(double damping, double stiffness) {
  // A short series for a part of the period, then doubled: avoids cancellation.
  int doublings = 0;
  double part = 1.0;
  while (std::max(damping * part, std::sqrt(stiffness) * part) > 0.25) {
    part *= 0.5;
    ++doublings;
  }
  double speed = 0.0, force = 0.0;
  double before = 0.0, term = part;  // of the Taylor series of the impulse response
  for (int n = 1; n < 20; ++n) {
    speed += term;
    force += term * part / (n + 1);
    const double next = -(damping * part * term + stiffness * part * part * before / n) / (n + 1);
    before = term;
    term = next;
  }
  for (; doublings > 0; --doublings) {
    const double twice = speed * (2.0 - 2.0 * stiffness * force - damping * speed);
    force = 2.0 * force - stiffness * force * force + speed * speed;
    speed = twice;
  }
  return {damping, stiffness, speed, force};
}

/// The loop in units of T and of the total mass: stiffness in m / T^2, damping in m / T.
class Loop {
 public:
  explicit Loop(const SampledLoop& loop) : delay_(loop.device.sample_delay) {
    const double mass = loop.device.apparent_mass + loop.grip.mass;
    const double period = 1.0 / loop.rate;
    unit_ = mass / (period * period);
    wall_damping_ = loop.wall_damping * period / mass;
    const Motion motion = motion_over_a_period((loop.device.viscous_friction + loop.grip.damping) * period / mass,
                                               loop.grip.stiffness / unit_);
    // G = (force w + rest) / (w^2 + drag w + spring) with w = z - 1, which keeps its precision where z is near 1.
    const double slowing = motion.damping * motion.speed + motion.stiffness * motion.force;
    force_ = motion.force;
    rest_ = motion.speed * motion.speed + slowing * motion.force;
    drag_ = slowing + motion.stiffness * motion.force;
    spring_ = motion.stiffness * rest_;
  }

  double unit() const noexcept { return unit_; }  ///< of stiffness [N/m]

  double wall_damping() const noexcept { return wall_damping_; }

  /// The stiffness at which z = exp(i angle) would be a root, if that were real.
  Complex stiffness_at(double angle) const noexcept {
    const Complex w = step_at(angle);
    const Complex inverse_motion = (w * w + drag_ * w + spring_) / (force_ * w + rest_);
    return -std::polar(1.0, angle * delay_) * inverse_motion - wall_damping_ * (w / (1.0 + w));
  }

  /// The wall damping at which z = exp(i angle) would be a root without any stiffness, if that were real.
  Complex wall_damping_at(double angle) const noexcept {
    const Complex w = step_at(angle);
    return -std::polar(1.0, angle * delay_) * (w + drag_ + spring_ / w) * (1.0 + w) / (force_ * w + rest_);
  }

 private:
  static Complex step_at(double angle) noexcept {
    const double half = std::sin(0.5 * angle);
    return {-2.0 * half * half, std::sin(angle)};
  }

  int delay_;
  double unit_, wall_damping_;
  double force_, rest_, drag_, spring_;
};

/// Angles between which to look for crossings. The imaginary part of the function is sin(angle) times a polynomial in
/// cos(angle) of degree d + 1: it has at most that many zeros, which the even spacing separates. The other angles find
/// those of a slow motion near z = 1.
std::vector<double> angles(int delay) {
  constexpr double min_angle = 1e-9;
  constexpr int per_decade = 20, per_zero = 32;
  std::vector<double> all;
  const int even = per_zero * (delay + 2);
  const double step = std::numbers::pi / even;
  for (double angle = min_angle; angle < step; angle *= std::pow(10.0, 1.0 / per_decade)) all.push_back(angle);
  for (int i = 1; i < even; ++i) all.push_back(i * step);
  return all;
}

/// The minimum positive value of `gain` where it is real, on the upper half of the unit circle; infinite if there is
/// none.
template <typename Gain>
double first_crossing(int delay, Gain gain) {
  double minimum = std::numeric_limits<double>::infinity();
  const auto consider = [&](double angle) {
    const double value = gain(angle).real();
    if (value > 0.0) minimum = std::min(minimum, value);
  };
  const auto is_negative = [&](double angle) { return std::signbit(gain(angle).imag()); };
  consider(std::numbers::pi);
  const std::vector<double> all = angles(delay);
  for (std::size_t i = 1; i < all.size(); ++i) {
    double low = all[i - 1], high = all[i];
    const bool below = is_negative(low);
    if (is_negative(high) == below) continue;
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = 0.5 * (low + high);
      (is_negative(middle) == below ? low : high) = middle;
    }
    consider(0.5 * (low + high));
  }
  return minimum;
}

}  // namespace

double critical_stiffness(const SampledLoop& sampled) {
  validate(sampled);
  const bool damped = sampled.device.viscous_friction + sampled.grip.damping > 0.0;
  if (!damped && (sampled.wall_damping == 0.0 || sampled.grip.stiffness > 0.0)) return 0.0;
  // Against a soft wall a damped motion stays damped, unless the damping of the wall is too high for the rate. With
  // increasing stiffness it stays damped until a root reaches the unit circle.
  const Loop loop(sampled);
  const auto damping_at = [&](double angle) { return loop.wall_damping_at(angle); };
  if (loop.wall_damping() > 0.0 && loop.wall_damping() >= first_crossing(sampled.device.sample_delay, damping_at))
    return 0.0;
  const double first =
      first_crossing(sampled.device.sample_delay, [&](double angle) { return loop.stiffness_at(angle); });
  // An infinitely stiff wall is never stable, so finding no crossing means that the damping is lost in rounding errors.
  return std::isfinite(first) ? first * loop.unit() : 0.0;
}

}  // namespace calligraphy
