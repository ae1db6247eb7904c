#include <calligraphy/render/stiffness_advice.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include <calligraphy/render/passivity_controller.hpp>

#include "base/require.hpp"

namespace calligraphy {
namespace {

using Complex = std::complex<double>;

constexpr double fastest_rate = 1e6;  // [Hz]
constexpr double largest = 1e9;       // of any other field, so that no product of them overflows
constexpr int max_delay = 1000;

/// For a device that states none: the minimum of the shipped profiles [N].
constexpr double presumed_friction = 0.04;

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
  constexpr double lowest = 1e-9;
  constexpr int per_decade = 20, per_zero = 32;
  std::vector<double> all;
  const int even = per_zero * (delay + 2);
  const double step = std::numbers::pi / even;
  for (double angle = lowest; angle < step; angle *= std::pow(10.0, 1.0 / per_decade)) all.push_back(angle);
  for (int i = 1; i < even; ++i) all.push_back(i * step);
  return all;
}

/// The minimum positive value of `gain` where it is real, on the upper half of the unit circle; infinite if there is
/// none.
template <typename Gain>
double first_crossing(int delay, Gain gain) {
  double smallest = std::numeric_limits<double>::infinity();
  const auto consider = [&](double angle) {
    const double value = gain(angle).real();
    if (value > 0.0) smallest = std::min(smallest, value);
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
  return smallest;
}

constexpr double heaviest_hand = 0.3;  // [kg]
constexpr double least_ratio = 0.1;    ///< damping ratio of a hand with a spring
constexpr double least_phase = 0.15;   // [rad]
constexpr double least_decay = 3.0;    // of the lightest pen [1/s]

/// A unit spring and a unit damper at one frequency, as the pen feels them.
struct Felt {
  double frequency;  ///< w [rad/s]
  Complex spring;    ///< per N/m of stiffness
  Complex damper;    ///< per N s/m
};

std::vector<Felt> felt_spring(const SampledLoop& loop, double velocity_cutoff) {
  constexpr double slowest = 0.5;  // [rad/s]: softer springs than 0.1 N/m are not looked at
  constexpr double ratio = 1.03;
  const double period = 1.0 / loop.rate;
  const double passed = -std::expm1(-2.0 * std::numbers::pi * velocity_cutoff * period);
  std::vector<Felt> all;
  for (double w = slowest; w * period < std::numbers::pi; w *= ratio) {
    const double angle = w * period;
    const Complex before = std::polar(1.0, -angle);  // one sample earlier
    const Complex held = std::polar(std::sin(0.5 * angle) / (0.5 * angle), -angle * (0.5 + loop.device.sample_delay));
    const Complex velocity = (1.0 - before) / period * passed / (1.0 - (1.0 - passed) * before);
    all.push_back({w, held, held * velocity});
  }
  return all;
}

/// Whether spring and damper keep every hand damped at one frequency. A hand with a spring has a damping ratio of at
/// least least_ratio by itself, whatever mass moves with it.
bool is_damped(const SampledLoop& loop, const Felt& at, const Complex& force, bool was_stiff) {
  const double mass = loop.device.apparent_mass;
  const double inertia = at.frequency * at.frequency;
  const double damping = force.imag() + loop.device.viscous_friction * at.frequency;
  for (const double hand : {0.0, 30.0, 100.0, 300.0, 1000.0}) {
    const double stiffness = hand + force.real();
    const bool can_resonate =
        (mass * inertia <= stiffness || (was_stiff && hand == 0.0)) && (mass + heaviest_hand) * inertia >= stiffness;
    if (!can_resonate) continue;
    const double own = hand > 0.0 ? 2.0 * least_ratio * std::sqrt(hand * std::max(0.0, stiffness)) : 0.0;
    const double phase = hand > 0.0 ? least_ratio : least_phase;
    const double needed = std::max(phase * stiffness, hand > 0.0 ? 0.0 : 2.0 * least_decay * mass * at.frequency);
    if (damping + own < needed) return false;
  }
  return true;
}

/// At every frequency at which a hand can make the pen resonate with the spring, and at the frequency above, so that no
/// such range is missed between two.
bool is_damped(const SampledLoop& loop, const std::vector<Felt>& felt, double stiffness) {
  // A spring so soft that nothing swings on it at the lowest frequency is only a damper.
  bool was_stiff = stiffness >= loop.device.apparent_mass * felt.front().frequency * felt.front().frequency;
  for (const Felt& at : felt) {
    const Complex force = stiffness * at.spring + loop.wall_damping * at.damper;
    if (!is_damped(loop, at, force, was_stiff)) return false;
    was_stiff = loop.device.apparent_mass * at.frequency * at.frequency <= force.real();
  }
  return !was_stiff;  // otherwise it resonates above half of the rate
}

StiffnessBound passive_bound(const SampledLoop& loop) {
  const double spare = std::max(0.0, loop.device.viscous_friction - loop.wall_damping);
  const char* of_delay = loop.device.sample_delay == 0 ? "exact (Colgate & Brown 1994)"
                         : loop.wall_damping == 0.0
                             ? "exact for B = 0 (derived from the condition of Colgate & Schenkel 1997)"
                             : "sufficient, not necessary, with both delay and B";
  return {2.0 * spare * loop.rate / (2.0 * loop.device.sample_delay + 1.0), "b > K T (2 d + 1) / 2 + |B|",
          std::string(of_delay) +
              ", for a rigid device in any passive hand: the damping of the grip is not counted; does not model "
              "quantisation, flexible links or saturation"};
}

StiffnessBound quantised_bound(const SampledLoop& loop, double passive) {
  double value = passive;
  if (loop.device.encoder_step > 0.0) {
    const double left = loop.device.coulomb_friction / loop.device.encoder_step - loop.wall_damping * loop.rate;
    value = std::min(value, std::max(0.0, 2.0 * left));
  }
  return {
      value, "K <= min(passive, 2 f_c / D - 2 B / T)",
      "Abbott & Okamura 2005 for B = 0 and no delay; the terms in B and d are the worst case, derived here; assumes "
      "uniform Coulomb friction and does not count the grip"};
}

StiffnessBound approximate_bound(const SampledLoop& loop) {
  const double damping = loop.device.viscous_friction + loop.grip.damping + loop.wall_damping;
  return {
      damping * loop.rate / (0.5 + loop.device.sample_delay), "K < (b + b_grip + B) / (T / 2 + d T)",
      "Gil et al. 2009: for small B only, where the loop is much faster than the motion; a factor of two too high at "
      "B = 30 N s/m and 1 kHz"};
}

}  // namespace

void validate(const SampledLoop& loop) {
  require_within("rate", loop.rate, "Hz", 1.0, fastest_rate);
  require_within("device.apparent_mass", loop.device.apparent_mass, "kg", 1e-9, largest);
  require_within("device.viscous_friction", loop.device.viscous_friction, "N s/m", 0.0, largest);
  require_within("device.coulomb_friction", loop.device.coulomb_friction, "N", 0.0, largest);
  require_within("device.encoder_step", loop.device.encoder_step, "m", 0.0, largest);
  require_within("wall_damping", loop.wall_damping, "N s/m", 0.0, largest);
  require_within("grip.mass", loop.grip.mass, "kg", 0.0, largest);
  require_within("grip.damping", loop.grip.damping, "N s/m", 0.0, largest);
  require_within("grip.stiffness", loop.grip.stiffness, "N/m", 0.0, largest);
  require_within("device.sample_delay", loop.device.sample_delay, "ticks", 0, max_delay);
}

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

double stiffness_for_any_hand(const SampledLoop& loop, double velocity_cutoff, double most) {
  validate(loop);
  require_above_zero("velocity_cutoff", velocity_cutoff, "Hz");
  const std::vector<Felt> felt = felt_spring(loop, velocity_cutoff);
  if (is_damped(loop, felt, most)) return most;
  double low = 0.0, high = most;
  for (int halving = 0; halving < 30; ++halving) {
    const double middle = 0.5 * (low + high);
    (is_damped(loop, felt, middle) ? low : high) = middle;
  }
  // So soft a spring that nothing swings on it at the lowest frequency looked at.
  const double softest = loop.device.apparent_mass * felt.front().frequency * felt.front().frequency;
  return low > softest * (1.0 + 1e-6) ? low : 0.0;
}

StiffnessAdvice advise_stiffness(const SampledLoop& loop) {
  validate(loop);
  StiffnessAdvice advice;
  advice.passive = passive_bound(loop);
  advice.quantised = quantised_bound(loop, advice.passive.value);
  advice.stable = {
      critical_stiffness(loop),
      "exact zero-order hold: all roots of z^(d+1) D(z) + (K z + B (z - 1) / T) N(z) inside |z| = 1",
      "exact for a rigid mass in this grip on a bilateral wall; does not model flexible links, which make it "
      "optimistic, nor Coulomb friction, quantisation and saturation"};
  advice.approximate = approximate_bound(loop);
  return advice;
}

double injectable_damping(const SampledLoop& loop) {
  validate(loop);
  double damping =
      PassivityController::usable_damping(loop.device.apparent_mass, 1.0 / loop.rate, loop.device.sample_delay) -
      loop.wall_damping;
  if (loop.device.encoder_step > 0.0) {
    const double held = loop.device.coulomb_friction > 0.0 ? loop.device.coulomb_friction : presumed_friction;
    damping = std::min(damping, held / (loop.device.encoder_step * loop.rate));
  }
  return std::max(0.0, damping);
}

}  // namespace calligraphy
