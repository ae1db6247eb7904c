#include <calligraphy/render/stiffness_advice.hpp>

#include <algorithm>
#include <string>

#include "base/require.hpp"

namespace calligraphy {
namespace {

constexpr double max_rate = 1e6;   // [Hz]
constexpr double max_value = 1e9;  // of any other field, so that no product of them overflows
constexpr int max_sample_delay = 1000;

/// Coulomb friction assumed of a device that states none: the minimum of the shipped profiles [N].
constexpr double presumed_friction = 0.04;

/// Share of the damping beyond which a mass is thrown back within one period.
constexpr double inertial_share = 0.9;

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
  require_within("rate", loop.rate, "Hz", 1.0, max_rate);
  require_within("device.apparent_mass", loop.device.apparent_mass, "kg", 1e-9, max_value);
  require_within("device.viscous_friction", loop.device.viscous_friction, "N s/m", 0.0, max_value);
  require_within("device.coulomb_friction", loop.device.coulomb_friction, "N", 0.0, max_value);
  require_within("device.encoder_step", loop.device.encoder_step, "m", 0.0, max_value);
  require_within("wall_damping", loop.wall_damping, "N s/m", 0.0, max_value);
  require_within("grip.mass", loop.grip.mass, "kg", 0.0, max_value);
  require_within("grip.damping", loop.grip.damping, "N s/m", 0.0, max_value);
  require_within("grip.stiffness", loop.grip.stiffness, "N/m", 0.0, max_value);
  require_within("device.sample_delay", loop.device.sample_delay, "ticks", 0, max_sample_delay);
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
  const double period = 1.0 / loop.rate;
  const double tolerated = inertial_share * loop.device.apparent_mass / (period * (1 + 2 * loop.device.sample_delay));
  double damping = tolerated - loop.wall_damping;
  if (loop.device.encoder_step > 0.0) {
    const double held = loop.device.coulomb_friction > 0.0 ? loop.device.coulomb_friction : presumed_friction;
    damping = std::min(damping, held / (loop.device.encoder_step * loop.rate));
  }
  return std::max(0.0, damping);
}

}  // namespace calligraphy
