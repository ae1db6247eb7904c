// How stiff a sampled virtual wall may be, given a device, its servo loop and a grip.
#pragma once

#include <string>

#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/devices/device_state.hpp>

namespace calligraphy {

/// A point mass held against a sampled virtual wall: the force -K x - B (x - x_before) / T is computed once per tick
/// from the newest sample and held until the next. One axis; everything that the stiffness bounds depend on.
struct SampledLoop {
  Capabilities device;                   ///< m, b, f_c, D, d: mass, viscous and Coulomb friction, encoder step, delay
  double rate = 1000.0;                  ///< 1 / T: of the servo loop, which may differ from the device's own [Hz]
  GripImpedance grip = {0.0, 0.0, 0.0};  ///< moves with the device; by default nobody holds it
  double wall_damping = 0.0;             ///< B: of the wall, on the backward difference of the samples [N s/m]
};

/// Checks a loop. @throws ValueError naming the field and its value: not finite, negative or above 1e9; a rate outside
/// [1, 1e6] Hz, an apparent mass below 1e-9 kg (0 means "unknown"), a sample delay outside [0, 1000] ticks
void validate(const SampledLoop& loop);

/// Minimum stiffness of a bilateral wall at which a linear motion of device and grip no longer decays, without Coulomb
/// friction and quantisation [N/m]. Exact: uses the discrete motion under a zero-order hold of the force. 0 when the
/// loop oscillates however soft the wall: when neither device nor wall is damped, when only the wall is damped and the
/// grip has a spring, and when the wall's damping is so large that it drives an oscillation by itself.
///
/// Derived here: with G(z) the sampled motion, an oscillation is sustained where K = -z^d / G(z) - B (1 - 1/z) / T is
/// real on the unit circle.
/// @throws ValueError as validate()
double critical_stiffness(const SampledLoop& loop);

/// Maximum stiffness, up to `most` [N/m], of a spring with `loop.wall_damping` that keeps the pen damped in every hand:
/// nobody, or any mass up to 0.3 kg, with any damping, and with a spring of up to 1,000 N/m in a hand whose own damping
/// ratio is at least 0.1. The damper acts on the backward difference of the samples behind a first-order low-pass at
/// `velocity_cutoff` [Hz] (VelocityEstimator). `loop.grip` is not used. 0 when the damper alone is too strong for the
/// loop's lag, or too weak.
///
/// The criterion, derived in docs/stability-derivation.md: H(jw), the spring and the damper as the pen feels them through
/// sampling, delay, filter and zero-order hold, plus the device's own b jw, has a phase of at least 0.15 rad at every
/// frequency w at which a mass from the device's to 0.3 kg more resonates with it, m w^2 = Re H: the damping ratio is
/// then at least 0.075. It also makes an oscillation of the device alone decay at 3 /s or faster. The spring may be
/// weakened at any time (saturation, fading, assistance).
/// @throws ValueError as validate(), or naming velocity_cutoff unless it is above 0
double stiffness_for_any_hand(const SampledLoop& loop, double velocity_cutoff, double most);

/// A bound on the stiffness of the wall, with its validity.
struct StiffnessBound {
  double value = 0.0;    ///< bound on the wall's stiffness [N/m]
  std::string formula;   ///< as text, in the symbols of SampledLoop
  std::string validity;  ///< one line: where it holds and what it does not model
};

/// Bounds on the stiffness of the wall in one loop.
struct StiffnessAdvice {
  StiffnessBound passive;      ///< the wall generates no energy, whoever holds the device
  StiffnessBound quantised;    ///< passive, and the quantisation of positions cannot sustain an oscillation either
  StiffnessBound stable;       ///< critical_stiffness(): below it the linear motion in this grip decays
  StiffnessBound approximate;  ///< a rule of thumb for `stable`, for comparison
};

/// The stiffness bounds of a loop. Both passivity and stability are reported, because a device may work well while not
/// passive (Diolaiti et al. 2006).
///
/// The passive bounds count only the device's own damping: the wall is passive towards any hand, and stable without
/// one. The stable bound holds for the given grip only.
/// @throws ValueError as validate()
StiffnessAdvice advise_stiffness(const SampledLoop& loop);

/// Maximum damping that a passivity controller (experiments) may inject into this loop [N s/m]: 0.9 m / (T (1 + 2 d)),
/// which the device's mass tolerates without being thrown back within one period, less the wall's own, and at most f_c
/// T / D, so that Coulomb friction can hold the force of one encoder step within a tick. Above that, quantisation
/// sustains a limit cycle (found by the stability map: at 4 kHz a controller without the last limit allows less
/// stiffness than no controller). If no Coulomb friction is stated, 0.04 N are assumed.
/// @throws ValueError as validate()
double injectable_damping(const SampledLoop& loop);

}  // namespace calligraphy
