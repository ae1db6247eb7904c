#include <calligraphy/render/stiffness_advice.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "base/require.hpp"

namespace calligraphy {
namespace {

constexpr double max_hand_mass = 0.3;           // [kg]
constexpr double min_hand_damping_ratio = 0.1;  ///< damping ratio of a hand with a spring
constexpr double min_phase = 0.15;              // [rad]
constexpr double min_decay = 3.0;               // of the lightest pen [1/s]

/// A unit spring and a unit damper at one frequency, as the pen feels them.
struct Felt {
  double frequency;             ///< w [rad/s]
  std::complex<double> spring;  ///< per N/m of stiffness
  std::complex<double> damper;  ///< per N s/m
};

std::vector<Felt> felt_spring(const SampledLoop& loop, double velocity_cutoff) {
  constexpr double min_frequency = 0.5;  // [rad/s]: springs softer than 0.1 N/m are not considered
  constexpr double ratio = 1.03;
  const double period = 1.0 / loop.rate;
  const double passed = -std::expm1(-2.0 * std::numbers::pi * velocity_cutoff * period);
  std::vector<Felt> all;
  for (double w = min_frequency; w * period < std::numbers::pi; w *= ratio) {
    const double angle = w * period;
    const std::complex<double> before = std::polar(1.0, -angle);  // one sample earlier
    const std::complex<double> held =
        std::polar(std::sin(0.5 * angle) / (0.5 * angle), -angle * (0.5 + loop.device.sample_delay));
    const std::complex<double> velocity = (1.0 - before) / period * passed / (1.0 - (1.0 - passed) * before);
    all.push_back({w, held, held * velocity});
  }
  return all;
}

/// Whether spring and damper keep every hand damped at one frequency. A hand with a spring has a damping ratio of at
/// least min_hand_damping_ratio by itself, whatever mass moves with it.
bool is_damped(const SampledLoop& loop, const Felt& at, const std::complex<double>& force, bool was_stiff) {
  const double mass = loop.device.apparent_mass;
  const double inertia = at.frequency * at.frequency;
  const double damping = force.imag() + loop.device.viscous_friction * at.frequency;
  for (const double hand : {0.0, 30.0, 100.0, 300.0, 1000.0}) {
    const double stiffness = hand + force.real();
    const bool can_resonate =
        (mass * inertia <= stiffness || (was_stiff && hand == 0.0)) && (mass + max_hand_mass) * inertia >= stiffness;
    if (!can_resonate) continue;
    const double own = hand > 0.0 ? 2.0 * min_hand_damping_ratio * std::sqrt(hand * std::max(0.0, stiffness)) : 0.0;
    const double phase = hand > 0.0 ? min_hand_damping_ratio : min_phase;
    const double needed = std::max(phase * stiffness, hand > 0.0 ? 0.0 : 2.0 * min_decay * mass * at.frequency);
    if (damping + own < needed) return false;
  }
  return true;
}

/// Checks every frequency at which a hand can make the pen resonate with the spring, and the next one above, so that no
/// such range is missed between two.
bool is_damped(const SampledLoop& loop, const std::vector<Felt>& felt, double stiffness) {
  // A spring so soft that nothing swings on it at the lowest frequency is only a damper.
  bool was_stiff = stiffness >= loop.device.apparent_mass * felt.front().frequency * felt.front().frequency;
  for (const Felt& at : felt) {
    const std::complex<double> force = stiffness * at.spring + loop.wall_damping * at.damper;
    if (!is_damped(loop, at, force, was_stiff)) return false;
    was_stiff = loop.device.apparent_mass * at.frequency * at.frequency <= force.real();
  }
  return !was_stiff;  // otherwise it resonates above half of the rate
}

}  // namespace

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
  // On a softer spring nothing swings at the lowest frequency considered.
  const double min_stiffness = loop.device.apparent_mass * felt.front().frequency * felt.front().frequency;
  return low > min_stiffness * (1.0 + 1e-6) ? low : 0.0;
}

}  // namespace calligraphy
