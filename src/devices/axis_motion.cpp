#include "axis_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace calligraphy {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Motion with constant sign of velocity: x'' + 2 decay x' + frequency^2 x = push + ramp t, x(0) = 0, x'(0) = velocity.
struct Slide {
  double velocity;  ///< [m/s]
  double push;      ///< [m/s^2]
  double ramp;      ///< [m/s^3]

  double displacement(const ImpulseResponse& response) const noexcept {
    return velocity * response.value + push * response.integral + ramp * response.double_integral;
  }
  double velocity_after(const ImpulseResponse& response) const noexcept {
    return velocity * response.derivative + push * response.value + ramp * response.integral;
  }
  // The acceleration solves the homogeneous equation: start * derivative + slope * value.
  double acceleration_start(const Oscillator& oscillator) const noexcept {
    return push - 2.0 * oscillator.decay() * velocity;
  }
  double acceleration_slope(const Oscillator& oscillator) const noexcept {
    return ramp - oscillator.frequency_squared() * velocity;
  }
};

/// Zero of the velocity in low..high, where it changes monotonically from the sign `direction` to the opposite one:
/// Newton's method, with bisection where it would leave the bracket.
double stop_within(const Oscillator& oscillator, const Slide& slide, double direction, double low,
                   double high) noexcept {
  const double start = slide.acceleration_start(oscillator);
  const double slope = slide.acceleration_slope(oscillator);
  double time = 0.5 * (low + high);
  for (int i = 0; i < 100; ++i) {
    const ImpulseResponse response = oscillator.impulse_response(time);
    const double velocity = slide.velocity_after(response);
    if (velocity == 0.0) return time;
    (direction * velocity > 0.0 ? low : high) = time;
    const double acceleration = start * response.derivative + slope * response.value;
    double next = time - velocity / acceleration;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const bool settled = std::abs(next - time) <= std::numeric_limits<double>::epsilon() * time;
    time = next;
    if (settled) break;
  }
  return time;
}

/// Time at which the velocity, which has the sign `direction` or is about to take it, first vanishes; infinity if not
/// before `seconds`. Oscillations about the target's velocity only decay, so only the first reversal can reach zero.
double first_stop(const Oscillator& oscillator, const Slide& slide, double direction, double seconds) noexcept {
  const double start = slide.acceleration_start(oscillator);
  const double slope = slide.acceleration_slope(oscillator);
  double low = 0.0;
  double high = oscillator.first_zero(start, slope);
  const bool slows_down = direction * (start == 0.0 ? slope : start) < 0.0;
  if (!slows_down) {
    low = high;
    high = low + oscillator.half_period();
  }
  if (!(low < seconds)) return infinity;
  high = std::min(high, seconds);
  if (direction * slide.velocity_after(oscillator.impulse_response(high)) > 0.0) return infinity;
  return stop_within(oscillator, slide, direction, low, high);
}

/// Time for which friction holds a mass at rest against `drive` [N], which changes at `rate` [N/s].
double sticking_time(double drive, double rate, double dry_friction) noexcept {
  if (rate == 0.0) return infinity;
  return (std::copysign(dry_friction, rate) - drive) / rate;
}

}  // namespace

AxisState advance_axis(const Oscillator& oscillator, const ImpulseResponse& whole_step, AxisState start,
                       const AxisLoad& load, double seconds) noexcept {
  const double rate = oscillator.stiffness() * load.target_velocity;  // of the spring force at rest [N/s]
  AxisState state = start;
  double remaining = seconds;
  for (int phase = 0; phase < max_phases && remaining > 0.0; ++phase) {
    const double target = load.target + load.target_velocity * (seconds - remaining);
    const double drive = load.force + oscillator.stiffness() * (target - state.position);
    double direction = std::copysign(1.0, state.velocity == 0.0 ? drive : state.velocity);
    double net_force = drive - direction * load.dry_friction;
    if (state.velocity == 0.0 && std::abs(drive) <= load.dry_friction) {
      const double stuck = sticking_time(drive, rate, load.dry_friction);
      if (!(stuck < remaining)) return state;
      remaining -= stuck;
      direction = std::copysign(1.0, rate);
      net_force = 0.0;  // by definition of breakaway; recomputing it would leave a rounding error of either sign
    }
    const Slide slide{state.velocity, net_force / oscillator.mass(), rate / oscillator.mass()};
    const double stop = load.dry_friction > 0.0 ? first_stop(oscillator, slide, direction, remaining) : infinity;
    const double duration = std::min(stop, remaining);
    const ImpulseResponse response = duration == seconds ? whole_step : oscillator.impulse_response(duration);
    state.position += slide.displacement(response);
    state.velocity = stop <= remaining ? 0.0 : slide.velocity_after(response);
    remaining -= duration;
  }
  return state;
}

}  // namespace calligraphy
