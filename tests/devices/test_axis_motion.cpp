// The closed-form solutions behind the simulated device, from arbitrary states: the device itself starts at rest.
#include <algorithm>
#include <cmath>

#include <calligraphy/base/random.hpp>

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

TEST_CASE("the response is continuous where the formula changes", "[devices]") {
  const double ratio = GENERATE(0.0, 0.3, 1.0 - 1e-12, 1.0, 1.0 + 1e-12, 3.0, 1e3);
  const Oscillator oscillator(1.0, 2.0 * ratio, 1.0);
  const double edge = ratio <= 1.0 ? 1.0 : 1.0 / (ratio + std::sqrt(ratio * ratio - 1.0));
  const ImpulseResponse below = oscillator.impulse_response(edge * (1.0 - 1e-14));
  const ImpulseResponse above = oscillator.impulse_response(edge * (1.0 + 1e-14));
  CAPTURE(ratio);
  CHECK(above.derivative == Approx(below.derivative).margin(2e-13));
  CHECK(above.value == Approx(below.value).epsilon(2e-13));
  CHECK(above.integral == Approx(below.integral).epsilon(2e-13));
  CHECK(above.double_integral == Approx(below.double_integral).epsilon(2e-13));
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

TEST_CASE("from any state one step equals a thousand small ones", "[devices]") {
  Random random(20060704);
  const auto between = [&](double low, double high) { return random.between(low, high); };
  int stops = 0;
  for (int run = 0; run < 3000; ++run) {
    const double mass = std::exp(between(-4.0, 1.0));
    const double stiffness = run % 5 == 0 ? 0.0 : mass * std::exp(between(0.0, 8.0));
    const double critical = 2.0 * std::sqrt(mass * (stiffness > 0.0 ? stiffness : mass));
    const double damping = run % 7 == 0 ? 0.0 : critical * std::exp(between(-4.0, 2.0));
    const Oscillator oscillator(mass, damping, stiffness);
    const double speed = between(-1.0, 1.0);
    AxisLoad load;
    load.target = between(-0.1, 0.1);
    load.target_velocity = run % 3 == 0 ? 0.0 : between(-1.0, 1.0) * std::abs(speed);
    load.dry_friction = critical * std::exp(between(-6.0, 0.0));
    load.force = load.dry_friction * between(-3.0, 3.0);
    const double seconds = std::exp(between(-4.0, 0.0));
    const AxisState start{between(-0.1, 0.1), speed};
    const AxisState once = move(oscillator, start, load, seconds, 1);
    const AxisState often = move(oscillator, start, load, seconds, 1000);
    CAPTURE(run, mass, damping, stiffness, seconds);
    REQUIRE(std::abs(once.position - often.position) < 1e-10);
    REQUIRE(std::abs(once.velocity - often.velocity) < 1e-9);
    stops += once.velocity * speed <= 0.0;
  }
  CHECK(stops > 300);
}
