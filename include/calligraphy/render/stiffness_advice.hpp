// How stiff a sampled wall may be: what a device, its servo loop and a grip allow.
#pragma once

#include <string>

#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/devices/device_state.hpp>

namespace calligraphy {

/// A point mass held against a wall that is computed once a tick: the force -K x - B (x - x_before) / T from the
/// newest sample, held until the next. One axis; all that a stiffness has to be judged by.
struct SampledLoop {
  Capabilities device;          ///< m, b, f_c, D and d: mass, frictions, encoder step and sample delay
  double rate = 1000.0;         ///< 1 / T: of the servo loop, which need not be the device's own [Hz]
  Hand grip = {0.0, 0.0, 0.0};  ///< moves with the device; by default nobody holds it
  double wall_damping = 0.0;    ///< B: of the wall, by the backward difference of the samples [N s/m]
};

/// @throws ValueError naming the field and its value: one that is not finite, negative or above 1e9; a rate that is not
/// in [1, 1e6] Hz, an apparent mass below 1e-9 kg (0 is "not known"), a sample delay that is not in [0, 1000] ticks
void validate(const SampledLoop& loop);

/// Smallest stiffness of a bilateral wall at which a linear motion of device and grip no longer dies away, without dry
/// friction and rounding [N/m]. Exact: the motion from sample to sample under a force that is held. 0 when the loop
/// keeps swinging however soft the wall: when neither device nor wall damps it, when only the wall does and the grip is
/// a spring, and when the wall's damping is so large that it feeds a swing by itself.
///
/// Derived here. With G(z) the sampled motion, a swing is kept up where K = -z^d / G(z) - B (1 - 1/z) / T is real on
/// the unit circle.
/// @throws ValueError as validate()
double critical_stiffness(const SampledLoop& loop);

/// A bound of the wall's stiffness, and what it is worth.
struct StiffnessBound {
  double value = 0.0;    ///< [N/m]
  std::string formula;   ///< as text, in the letters of SampledLoop
  std::string validity;  ///< one line: where it holds and what it does not see
};

struct StiffnessAdvice {
  StiffnessBound passive;      ///< the wall never gives out energy, whoever holds the device
  StiffnessBound quantised;    ///< passive, and no rounding of the positions can keep up a swing either
  StiffnessBound stable;       ///< critical_stiffness(): the linear motion in this grip dies away below it
  StiffnessBound approximate;  ///< a rule of thumb for `stable`, to compare
};

/// The bounds of a loop. Both verdicts are worth having: a device may run well while not passive (Diolaiti et al.
/// 2006).
///
/// The passive bounds count the device's own damping alone: they promise that the wall is passive towards any hand, so
/// that none need be there. The stable one holds for this grip and no other.
/// @throws ValueError as validate()
StiffnessAdvice advise_stiffness(const SampledLoop& loop);

/// Largest damping that a PassivityController may inject into this loop [N s/m]: what the device's mass bears at its
/// rate and delay, less the wall's own, and no more than f_c T / D, so that the force on one step of the encoder within
/// a tick is held by dry friction. Above that the steps themselves keep up a swing (found by the stability map: a
/// controller without the last limit settles less stiffness at 4 kHz than none). Where no dry friction is stated,
/// 0.04 N are presumed.
/// @throws ValueError as validate()
double injectable_damping(const SampledLoop& loop);

}  // namespace calligraphy
