#include "oscillator.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace calligraphy {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// (1 - exp(-z)) / z, the mean of exp(-s) over 0..z.
double mean_decay(double z) noexcept { return z == 0.0 ? 1.0 : -std::expm1(-z) / z; }

/// (z - 1 + exp(-z)) / z^2; the direct formula suffers from cancellation for small z.
double mean_decay_integral(double z) noexcept {
  if (z > 0.5) return (z + std::expm1(-z)) / (z * z);
  double term = 0.5;
  double sum = term;
  for (int n = 3; n < 18; ++n) {
    term *= -z / n;
    sum += term;
  }
  return sum;
}

}  // namespace

Oscillator::Oscillator(double mass, double damping, double stiffness) noexcept
    : mass_(mass), stiffness_(stiffness), decay_(0.5 * damping / mass), frequency_squared_(stiffness / mass) {
  const double frequency = std::sqrt(frequency_squared_);
  oscillates_ = frequency > decay_;
  // (a - b)(a + b) instead of a^2 - b^2: accurate near critical damping, where cancellation would dominate.
  if (oscillates_) {
    ringing_ = std::sqrt(frequency - decay_) * std::sqrt(frequency + decay_);
  } else {
    fast_rate_ = decay_ + std::sqrt(decay_ - frequency) * std::sqrt(decay_ + frequency);
    slow_rate_ = fast_rate_ > 0.0 ? frequency * (frequency / fast_rate_) : 0.0;
  }
}

ImpulseResponse Oscillator::impulse_response(double seconds) const noexcept {
  // Below one radian or one time constant the closed forms suffer from cancellation, and the series is short.
  const double fastest = oscillates_ ? std::sqrt(frequency_squared_) : fast_rate_;
  if (fastest * seconds <= 1.0) return power_series(seconds);
  return oscillates_ ? oscillating(seconds) : aperiodic(seconds);
}

ImpulseResponse Oscillator::power_series(double seconds) const noexcept {
  const double damping = -2.0 * decay_ * seconds;
  const double spring = -frequency_squared_ * seconds * seconds;
  double term = seconds;  // n-th term of the Taylor series of the value
  double next = 0.5 * damping * seconds;
  double value = 0.0;
  double integral = 0.0;
  double double_integral = 0.0;
  constexpr double negligible = 0.1 * std::numeric_limits<double>::epsilon();
  for (int n = 1; n < 26; ++n) {
    value += term;
    integral += term / (n + 1);
    double_integral += term / ((n + 1) * (n + 2));
    if (std::abs(term) + std::abs(next) <= negligible * seconds) break;
    const double after_next = (damping * next + spring * term / (n + 1)) / (n + 2);
    term = next;
    next = after_next;
  }
  ImpulseResponse response;
  response.value = value;
  response.integral = integral * seconds;
  response.double_integral = double_integral * seconds * seconds;
  response.derivative = 1.0 - 2.0 * decay_ * response.value - frequency_squared_ * response.integral;
  return response;
}

ImpulseResponse Oscillator::oscillating(double seconds) const noexcept {
  const double angle = ringing_ * seconds;
  const double envelope = std::exp(-decay_ * seconds);
  const double mean_cosine = angle == 0.0 ? 1.0 : std::sin(angle) / angle;  // of 0..angle; 1 at critical damping
  ImpulseResponse response;
  response.value = envelope * mean_cosine * seconds;
  response.derivative = envelope * std::cos(angle) - decay_ * response.value;
  response.integral = (1.0 - response.derivative - 2.0 * decay_ * response.value) / frequency_squared_;
  response.double_integral = (seconds - response.value - 2.0 * decay_ * response.integral) / frequency_squared_;
  return response;
}

ImpulseResponse Oscillator::aperiodic(double seconds) const noexcept {
  // (d/dt + fast) y = exp(-slow t): integrating this chain of two first-order lags divides only by the fast rate, so
  // neither equal rates nor a missing spring (slow = 0) cause a division by zero.
  const double slow = slow_rate_ * seconds;
  ImpulseResponse response;
  response.value = std::exp(-slow) * seconds * mean_decay((fast_rate_ - slow_rate_) * seconds);
  response.derivative = std::exp(-fast_rate_ * seconds) - slow_rate_ * response.value;
  response.integral = (seconds * mean_decay(slow) - response.value) / fast_rate_;
  response.double_integral = (seconds * seconds * mean_decay_integral(slow) - response.integral) / fast_rate_;
  return response;
}

double Oscillator::first_zero(double start, double slope) const noexcept {
  // The solution is start * derivative + slope * value.
  if (start == 0.0) return half_period();
  if (oscillates_) {
    const double angle = std::atan2(-start, (slope - decay_ * start) / ringing_);
    return (angle > 0.0 ? angle : angle + std::numbers::pi) / ringing_;
  }
  const double ratio = start / (start * fast_rate_ - slope);  // mean_decay(spread t) t at the zero
  if (!(ratio > 0.0)) return never;
  const double spread = fast_rate_ - slow_rate_;
  if (spread == 0.0) return ratio;
  return spread * ratio < 1.0 ? -std::log1p(-spread * ratio) / spread : never;
}

double Oscillator::half_period() const noexcept { return oscillates_ ? std::numbers::pi / ringing_ : never; }

}  // namespace calligraphy
