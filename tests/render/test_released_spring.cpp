// Guidance that lets go: a force that is withdrawn in time and never throws the pen.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>

#include "render/released_spring.hpp"
#include "../hard_cases.hpp"
#include "../held_mass.hpp"

namespace released_spring_tests {

using namespace calligraphy;

namespace {

constexpr double stiffness = 600.0, damping = 4.0;
const Point held(1.2, -1.6);  // 2 N

}  // namespace

TEST_CASE("what is released of a force on a pen at rest is never more than it was, nor of the other sign", "[render]") {
  calligraphy_test::Sequence random(3);
  for (int run = 0; run < 200; ++run) {
    const Point force = random.point(-3.0, 3.0), direction = force.normalized();
    ReleasedSpring spring;
    spring.take_over(force, random.point(0.0, 0.1), {0, 0}, stiffness, damping, 300.0);
    double strongest = 0.0, weakest = 0.0, across = 0.0;
    for (int tick = 0; tick < 400; ++tick) {
      const Point now = spring.next(random.point(-0.1, 0.2), {0, 0});
      strongest = std::max(strongest, now.dot(direction) - force.norm());
      weakest = std::min(weakest, now.dot(direction));
      across = std::max(across, std::abs(now.x() * direction.y() - now.y() * direction.x()));
    }
    CHECK(strongest <= 1e-12);
    CHECK(weakest >= 0.0);
    CHECK(across <= 1e-12);
  }
}

TEST_CASE("what is released damps motion along it, by at most its damping, until it is over", "[render]") {
  calligraphy_test::Sequence random(5);
  for (int run = 0; run < 200; ++run) {
    const Point force = random.point(-3.0, 3.0), direction = force.normalized();
    ReleasedSpring moving;
    moving.take_over(force, {0, 0}, {0, 0}, stiffness, damping, 300.0);
    ReleasedSpring resting = moving;
    for (int tick = 0; tick < 400; ++tick) {
      const Point tip = random.point(-0.1, 0.2), velocity = random.point(-1.0, 1.0);
      const double along = velocity.dot(direction);
      const double added = (moving.next(tip, velocity) - resting.next(tip, {0, 0})).dot(direction);
      CHECK(added * along <= 0.0);
      CHECK(std::abs(added) <= damping * std::abs(along) * (1.0 + 1e-9));
      if (tick < 30) CHECK(std::abs(added) >= 0.99 * damping * std::abs(along));  // longer than the spring
      if (tick >= 300) CHECK(added == 0.0);
    }
  }
}

TEST_CASE("a force is taken over without a step, however fast the pen is", "[render]") {
  for (const Point& velocity : {Point(0, 0), Point(0.2, 0.1), Point(-0.05, 0.07)}) {
    ReleasedSpring spring;
    spring.take_over(held, {0.01, 0.02}, velocity, stiffness, damping, 1e6);
    CHECK(spring.next({0.01, 0.02}, velocity).isApprox(held, 1e-9));
  }
}

TEST_CASE("a pen at rest feels the force fall to zero in the time given, without a step", "[render]") {
  for (const double ticks : {1.0, 150.0, 300.0}) {
    ReleasedSpring spring;
    const Point tip(0.03, 0.04), velocity(0, 0);
    spring.take_over(held, tip, velocity, stiffness, damping, ticks);
    double last = held.norm(), largest = 0.0;
    for (int tick = 1; tick <= static_cast<int>(ticks); ++tick) {
      const double now = spring.next(tip, velocity).norm();
      CHECK(now <= last);
      if (tick == static_cast<int>(ticks) / 2 && ticks > 1.0) CHECK(now == Approx(0.5 * held.norm()).epsilon(0.02));
      largest = std::max(largest, last - now);
      last = now;
    }
    CAPTURE(ticks);
    CHECK(last == 0.0);
    CHECK(largest <= 1.5 / ticks * held.norm() * (1.0 + 1e-9) + (ticks == 1.0 ? held.norm() : 0.0));
    spring.take_over(held, tip, velocity, stiffness, damping, ticks);
    for (int tick = 0; tick < static_cast<int>(ticks); ++tick) spring.next(tip, velocity);
    // Over for good, wherever the pen goes.
    CHECK(spring.next(tip - 0.1 * held, velocity) == Point(0, 0));
  }
}

TEST_CASE("a force taken over for no time, no force, and one that is cleared act no longer", "[render]") {
  ReleasedSpring spring;
  CHECK(spring.next({0.1, 0.1}, {1, 1}) == Point(0, 0));
  spring.take_over(held, {0, 0}, {0, 0}, stiffness, damping, 0.0);
  CHECK(spring.next({0, 0}, {0, 0}) == Point(0, 0));
  spring.take_over({0, 0}, {0, 0}, {0, 0}, stiffness, damping, 300.0);
  CHECK(spring.next({-1, -1}, {-1, -1}) == Point(0, 0));
  spring.take_over(held, {0, 0}, {0, 0}, stiffness, damping, 300.0);
  spring.clear();
  CHECK(spring.next({0, 0}, {0, 0}) == Point(0, 0));
}

TEST_CASE("a pen that gives way by the length of the spring feels it no longer", "[render]") {
  ReleasedSpring spring;
  spring.take_over(held, {0, 0}, {0, 0}, stiffness, damping, 1e6);
  const Point slack = held / stiffness;
  CHECK(spring.next(0.5 * slack, {0, 0}).isApprox(0.5 * held, 1e-3));
  CHECK(spring.next(slack, {0, 0}).norm() < 1e-9);
  CHECK(spring.next(2.0 * slack, {0, 0}) == Point(0, 0));
  CHECK(spring.next(-slack, {0, 0}).isApprox(held, 1e-3));  // pulled against it
}

TEST_CASE("a bare mass that is let go of gains at most the energy of the spring", "[render]") {
  // F^2 / 2 K; a force held for as long as it fades would do far more.
  constexpr double force = 3.0, energy = force * force / (2.0 * stiffness), period = 1e-4;
  for (const double mass : {0.02, 0.045, 0.5}) {
    for (const double damper : {0.0, damping}) {
      for (const double seconds : {0.01, 0.15, 0.3, 3.0}) {
        ReleasedSpring spring;
        calligraphy_test::HeldMass pen(mass, 1e-6, period);
        spring.take_over({force, 0.0}, {0, 0}, {0, 0}, stiffness, damper, seconds / period);
        for (double time = 0.0; time < seconds + 0.1; time += period) {
          pen.advance(spring.next({pen.place, 0.0}, {pen.speed, 0.0}).x());
        }
        CAPTURE(mass, damper, seconds);
        const double gained = 0.5 * mass * pen.speed * pen.speed;
        CHECK(gained <= energy * (1.0 + 0.02));  // and what the sampling adds
        if (damper == 0.0) CHECK(gained > 0.0);
        if (damper == 0.0 && seconds == 3.0) CHECK(gained == Approx(energy).epsilon(0.05));
      }
    }
  }
}

}  // namespace released_spring_tests
