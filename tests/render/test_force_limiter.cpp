// The last stage: no step above the limit but what the pen's motion explains, no force above the peak, no lag.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "render/force_limiter.hpp"
#include "../hard_cases.hpp"

using namespace calligraphy;
using calligraphy_test::Sequence;
using Eigen::Vector3d;

namespace {

constexpr ForceLimiter limiter{0.1, 0.4, 3.3};
constexpr ForceLimiter unlimited{ForceLimiter::no_limit, ForceLimiter::no_limit, 3.3};

Vector3d random_force(Sequence& random, double largest) {
  const double x = random.between(-largest, largest), y = random.between(-largest, largest);
  return {x, y, random.between(-largest, largest)};
}

}  // namespace

TEST_CASE("no step exceeds the maximum step and the allowance, and no force the peak, whatever the targets",
          "[render]") {
  Sequence random(11);
  for (const double largest : {0.05, 1.0, 3.3, 10.0, 1e6, 1e100}) {
    for (const double allowed : {0.0, 0.02, 2.0}) {
      Vector3d force = Vector3d::Zero();
      double beyond = 0.0, max_step = 0.0, max_force = 0.0;
      for (int i = 0; i < 10'000; ++i) {
        Vector3d target = random_force(random, largest);
        if (i % 3 == 0) target = -force;
        if (i % 7 == 0) target = Vector3d(0.0, 0.0, largest);
        const ForceAllowance allowance{random.between(0.0, allowed), random.between(0.0, allowed)};
        const Vector3d next = limiter.next(force, target, allowance);
        const double most = std::hypot(0.1 + allowance.in_plane, 0.4 + allowance.normal);
        max_step = std::max(max_step, (next - force).norm());
        beyond = std::max(beyond, (next - force).norm() - most);
        max_force = std::max(max_force, next.norm());
        force = next;
      }
      INFO("targets up to " << largest << ", allowance up to " << allowed);
      CHECK(beyond <= 1e-12);
      if (allowed == 0.0) CHECK(max_step <= limiter.max_step() * (1.0 + 1e-12));
      CHECK(max_force <= 3.3 * (1.0 + 1e-12));
    }
  }
  CHECK(limiter.max_step() == Approx(std::hypot(0.1, 0.4)));
}

TEST_CASE("the in-plane and normal steps have separate limits, 0.1 and 0.4, and separate allowances", "[render]") {
  Vector3d next = limiter.next({0, 0, 0}, {3.0, 4.0, 5.0});
  CHECK(next.head<2>().norm() == Approx(0.1));
  CHECK(next.x() / next.y() == Approx(0.75));
  CHECK(next.z() == Approx(0.4));
  next = limiter.next({0, 0, 0}, {3.0, 4.0, 5.0}, {0.2, 0.05});
  CHECK(next.head<2>().norm() == Approx(0.3));
  CHECK(next.z() == Approx(0.45));
}

TEST_CASE("a target within reach is reached and held", "[render]") {
  Sequence random(12);
  for (int i = 0; i < 100; ++i) {
    const Vector3d target = random_force(random, 1.9);
    Vector3d force = random_force(random, 1.9);
    for (int k = 0; k < 60; ++k) force = limiter.next(force, target);
    CHECK(force == target);
  }
}

TEST_CASE("what reaches() says is reached is the next force, at any allowance, and what is not would take one",
          "[render]") {
  Sequence random(14);
  int reached = 0;
  for (const bool limits_rate : {true, false}) {
    const ForceLimiter& one = limits_rate ? limiter : unlimited;
    for (int i = 0; i < 20'000; ++i) {
      const Vector3d previous = random_force(random, 1.9);
      const Vector3d target = previous + random_force(random, i % 3 == 0 ? 0.05 : i % 3 == 1 ? 0.5 : 3.0);
      const double longest = i % 4 == 0 ? 2.0 : ForceLimiter::no_limit;
      const double allowed = i % 5 == 0 ? 0.3 : 0.0;
      const bool is_reached = one.reaches(previous, target, longest);
      const bool is_next = (one.next(previous, target, {}, longest) - target).norm() <= 1e-14;
      REQUIRE(is_reached == is_next);
      if (is_reached) REQUIRE((one.next(previous, target, {allowed, allowed}, longest) - target).norm() <= 1e-14);
      reached += is_reached;
    }
  }
  CHECK(reached > 10'000);
  CHECK(reached < 30'000);
}

TEST_CASE("a target above the peak is approached in its direction", "[render]") {
  const Vector3d target(6.0, -8.0, 24.0);
  Vector3d force = Vector3d::Zero();
  for (int i = 0; i < 5000; ++i) force = limiter.next(force, target);
  CHECK(force.isApprox(3.3 * target.normalized()));
  CHECK(unlimited.next({0, 0, 0}, target).isApprox(3.3 * target.normalized()));
}

TEST_CASE("where only one of the rates is limited, a device at fault is released by that one", "[render]") {
  const ForceLimiter one{ForceLimiter::no_limit, 0.4, 3.3}, other{0.1, ForceLimiter::no_limit, 3.3};
  CHECK(one.release({0, 0, 1.6}).isApprox(Vector3d(0, 0, 1.2)));
  CHECK(other.release({0, 0.5, 0}).isApprox(Vector3d(0, 0.4, 0)));
  CHECK(unlimited.release({1, 2, 3}) == Vector3d(0, 0, 0));
}

TEST_CASE("without a rate limit the force follows its target at once, up to the requested length", "[render]") {
  CHECK(unlimited.next({0, 0, 0}, {1.0, -2.0, 0.5}) == Vector3d(1.0, -2.0, 0.5));
  CHECK(unlimited.next({0, 0, 0}, {3.0, -4.0, 0.0}, {}, 2.0).isApprox(Vector3d(1.2, -1.6, 0.0)));
  CHECK(std::isinf(unlimited.max_step()));
}

TEST_CASE("whatever the motion, a target that jumped is approached at the limited rate, and then followed without lag",
          "[render]") {
  Sequence random(13);
  for (int run = 0; run < 300; ++run) {
    // In plane and along the normal separately: the distance at first, and how much the pen moves the target per tick.
    Vector3d target = random_force(random, 1.0), force = random_force(random, 1.0);
    const double fastest = std::pow(10.0, random.between(-3.0, 0.0));
    double in_plane = (target - force).head<2>().norm(), normal = std::abs(target.z() - force.z());
    const int reached = static_cast<int>(std::max(std::ceil(in_plane / 0.1), std::ceil(normal / 0.4))) + 1;
    double shortfall = 0.0, lag = 0.0;
    Vector3d motion(0, 0, 0);
    for (int i = 0; i < 200; ++i) {
      if (i % 20 == 0) motion = random_force(random, fastest);  // to and fro, within the peak
      Vector3d moved = target + (i % 3 ? 1.0 : -1.0) * random.next() * motion;
      if (moved.norm() > 3.0) moved = target;
      const ForceAllowance allowance{(moved - target).head<2>().norm(), std::abs(moved.z() - target.z())};
      target = moved;
      force = limiter.next(force, target, allowance);
      // Approached by at least a step per tick, however the target moves.
      shortfall = std::max(shortfall, (target - force).head<2>().norm() - std::max(0.0, in_plane - 0.1));
      shortfall = std::max(shortfall, std::abs(target.z() - force.z()) - std::max(0.0, normal - 0.4));
      in_plane = (target - force).head<2>().norm();
      normal = std::abs(target.z() - force.z());
      if (i + 1 >= reached) lag = std::max({lag, in_plane, normal});
    }
    CAPTURE(run, fastest, reached);
    CHECK(shortfall <= 1e-12);
    CHECK(lag <= 1e-12);
  }
}

TEST_CASE("a spring that appears while the pen swings in it is reached in |F| / step ticks, at every phase",
          "[render]") {
  // 600 N/m, to and fro by 4 mm at 8 Hz: up to 0.12 N per tick, more than a step.
  const auto spring = [](int tick, double phase) { return Vector3d(2.4 * std::sin(0.05 * tick + phase), 0.3, 0.0); };
  for (double phase = 0.0; phase < 6.3; phase += 0.3) {
    Vector3d force(0, 0, 0), lagging(0, 0, 0);
    const int reached = static_cast<int>(std::ceil(spring(0, phase).norm() / 0.1)) + 1;
    double lag = 0.0, without = 0.0;
    for (int i = 1; i < 1000; ++i) {
      const Vector3d target = spring(i, phase);
      force = limiter.next(force, target, {(target - spring(i - 1, phase)).norm(), 0.0});
      lagging = limiter.next(lagging, target);
      if (i > reached) lag = std::max(lag, (target - force).norm());
      if (i > 500) without = std::max(without, (target - lagging).norm());
    }
    CAPTURE(phase);
    CHECK(lag <= 1e-12);
    CHECK(without > 0.1);  // what the allowance is for
  }
}

TEST_CASE("a requested length takes effect at once, wherever the target is, and once it is lifted the rate holds",
          "[render]") {
  Sequence random(14);
  for (int run = 0; run < 200; ++run) {
    Vector3d force(0, 0, 0);
    for (int i = 0; i < 60; ++i) force = limiter.next(force, random_force(random, 5.0) + Vector3d(3.0, 0, 0));
    for (int i = 0; i < 40; ++i) {
      const double longest = random.between(0.0, 3.0);
      const Vector3d target = i % 2 ? random_force(random, 5.0) : Vector3d(3.0 * force + random_force(random, 3.0));
      const Vector3d shortened = limiter.next(force, target, {}, longest);
      CHECK(shortened.norm() <= longest * (1.0 + 1e-12));
      const Vector3d next = limiter.next(shortened, target);
      CHECK((next - shortened).norm() <= limiter.max_step() * (1.0 + 1e-12));
      force = next;
    }
  }
  CHECK(limiter.next({1.0, -2.0, 0.5}, {1.0, -2.0, 0.5}, {1.0, 1.0}, 0.0) == Vector3d(0, 0, 0));
}

TEST_CASE("a force whose targets all press never pulls", "[render]") {
  Sequence random(16);
  Vector3d force(0, 0, 0);
  double least = 0.0, longest = 3.3;
  for (int i = 0; i < 100'000; ++i) {
    Vector3d target = random_force(random, 4.0);
    target.z() = random.next() < 0.5 ? 0.0 : std::abs(target.z());
    if (i % 50 == 0) longest = random.between(0.0, 5.0);
    force = limiter.next(force, target, {random.between(0.0, 0.5), random.between(0.0, 0.5)}, longest);
    least = std::min(least, force.z());
  }
  CHECK(least == 0.0);
}

TEST_CASE("a release ramps straight to zero, in |F| over the maximum step ticks", "[render]") {
  Vector3d force(0, 0, 0);
  for (int i = 0; i < 60; ++i) force = limiter.next(force, {2.0, -1.0, 2.5});
  const Vector3d from = force;
  int ticks = 0;
  while (force != Vector3d(0, 0, 0)) {
    const Vector3d next = limiter.release(force);
    CHECK(next.cross(from).norm() < 1e-12);
    CHECK(next.dot(from) >= 0.0);
    force = next;
    ++ticks;
  }
  CHECK(ticks == static_cast<int>(std::ceil(from.norm() / limiter.max_step())));
}
