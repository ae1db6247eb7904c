// The closed-form solutions behind the simulated device, from arbitrary states: the device itself starts at rest.
#include <cmath>

#include "../catch.hpp"
#include "devices/axis_motion.hpp"

using namespace calligraphy;

namespace {

AxisState move(const Oscillator& oscillator, AxisState state, AxisLoad load, double seconds, int steps) {
  const double step = seconds / steps;
  const ImpulseResponse response = oscillator.impulse_response(step);
  for (int i = 0; i < steps; ++i) {
    state = advance_axis(oscillator, response, state, load, step);
    load.target += load.target_velocity * step;
  }
  return state;
}

}  // namespace

TEST_CASE("a vanishing spring acts like none, however strong the damper", "[devices]") {
  const double rate = GENERATE(1e-3, 1.0, 1e3, 1e6);
  const double turns = GENERATE(1.001, 3.0, 30.0, 1e4);
  const double seconds = turns / rate;
  CAPTURE(rate, turns);
  const ImpulseResponse weak = Oscillator(1.0, rate, 1e-13 * rate * rate).impulse_response(seconds);
  const long double r = rate, t = seconds, gone = -std::expm1(-r * t);
  const double tolerance = 1e-13 * turns + 1e-14;
  CHECK(weak.derivative == Approx(static_cast<double>(1 - gone)).epsilon(tolerance).margin(tolerance));
  CHECK(weak.value == Approx(static_cast<double>(gone / r)).epsilon(tolerance));
  CHECK(weak.integral == Approx(static_cast<double>((t - gone / r) / r)).epsilon(tolerance));
  CHECK(weak.double_integral == Approx(static_cast<double>((t * t / 2 - (t - gone / r) / r) / r)).epsilon(tolerance));
}

TEST_CASE("the response after a short time is accurate relative to its size", "[devices]") {
  const double ratio = GENERATE(0.0, 0.5, 1.0, 4.0);
  const double seconds = GENERATE(1e-12, 1e-9, 1e-6);
  const ImpulseResponse response = Oscillator(1.0, 2.0 * ratio, 1.0).impulse_response(seconds);
  // The first neglected terms of these are of the order of the time squared.
  CHECK(response.value == Approx(seconds * (1.0 - ratio * seconds)).epsilon(2e-11));
  CHECK(response.integral == Approx(0.5 * seconds * seconds * (1.0 - 2.0 / 3.0 * ratio * seconds)).epsilon(2e-11));
  CHECK(response.double_integral == Approx(std::pow(seconds, 3) / 6.0 * (1.0 - 0.5 * ratio * seconds)).epsilon(2e-11));
}

TEST_CASE("a mass thrown from the point where spring and friction balance slows down immediately", "[devices]") {
  const double direction = GENERATE(1.0, -1.0);
  const double damping = GENERATE(0.0, 64.0);
  const Oscillator oscillator(1.0, damping, 256.0);
  AxisLoad load;
  load.dry_friction = 0.25;
  // At the start the acceleration is exactly zero: force and spring balance friction and damper.
  load.force = direction * (0.25 + 0.13 * damping);
  const AxisState once = move(oscillator, {0.0, direction * 0.13}, load, 0.3, 1);
  const AxisState often = move(oscillator, {0.0, direction * 0.13}, load, 0.3, 1000);
  CHECK(once.position == Approx(often.position).epsilon(1e-10));
  CHECK(std::abs(once.velocity - often.velocity) < 1e-12);
}
