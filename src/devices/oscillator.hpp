// Linear motion of a mass on a spring and a damper, in closed form.
#pragma once

namespace calligraphy {

/// Impulse response at time t: y(t) for y'' + 2 decay y' + frequency^2 y = 0, y(0) = 0, y'(0) = 1, with its derivative
/// and its first two integrals from 0 to t. Every motion is a linear combination of these.
struct ImpulseResponse {
  double derivative = 1.0;       ///< y'(t) [1]
  double value = 0.0;            ///< y(t) [s]
  double integral = 0.0;         ///< [s^2]
  double double_integral = 0.0;  ///< [s^3]
};

/// m x'' + d x' + k x with m > 0, d >= 0, k >= 0.
class Oscillator {
 public:
  Oscillator(double mass, double damping, double stiffness) noexcept;

  /// Accurate to a few units in the last place for every t >= 0, also at and near critical damping.
  ImpulseResponse impulse_response(double seconds) const noexcept;

  /// First t > 0 at which a solution of the equation above with y(0) = start, y'(0) = slope - 2 decay start vanishes;
  /// infinity if it never does. [s]
  double first_zero(double start, double slope) const noexcept;

  /// Time between two zeros of any solution; infinity without oscillation. [s]
  double half_period() const noexcept;

  double mass() const noexcept { return mass_; }
  double stiffness() const noexcept { return stiffness_; }
  double decay() const noexcept { return decay_; }                          ///< d / (2 m) [1/s]
  double frequency_squared() const noexcept { return frequency_squared_; }  ///< k / m [1/s^2]

 private:
  ImpulseResponse power_series(double seconds) const noexcept;
  ImpulseResponse oscillating(double seconds) const noexcept;
  ImpulseResponse aperiodic(double seconds) const noexcept;

  double mass_;
  double stiffness_;
  double decay_;
  double frequency_squared_;
  bool oscillates_;
  double ringing_ = 0.0;    ///< angular frequency of a damped oscillation [1/s]
  double slow_rate_ = 0.0;  ///< the two rates of an aperiodic motion, 0 <= slow <= fast [1/s]
  double fast_rate_ = 0.0;
};

}  // namespace calligraphy
