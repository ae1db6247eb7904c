// The last stage: no step above the limit, no force above the peak, direction preserved, target reached.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include <calligraphy/render/detail/force_limiter.hpp>

#include "../hard_cases.hpp"

using namespace calligraphy;
using calligraphy_test::Sequence;
using Eigen::Vector3d;

namespace {

ForceLimiter limiter{0.1, 0.4, 3.3, true};

Vector3d random_force(Sequence& random, double largest) {
  const double x = random.between(-largest, largest), y = random.between(-largest, largest);
  return {x, y, random.between(-largest, largest)};
}

}  // namespace

TEST_CASE("no step exceeds the maximum step and no force the peak, whatever the targets", "[render]") {
  Sequence random(11);
  for (const double largest : {0.05, 1.0, 3.3, 10.0, 1e6, 1e100}) {
    Vector3d force = Vector3d::Zero();
    double max_step = 0.0, max_force = 0.0;
    for (int i = 0; i < 20'000; ++i) {
      Vector3d target = random_force(random, largest);
      if (i % 3 == 0) target = -force;
      if (i % 7 == 0) target = Vector3d(0.0, 0.0, largest);
      const Vector3d next = limiter.next(force, target);
      max_step = std::max(max_step, (next - force).norm());
      max_force = std::max(max_force, next.norm());
      force = next;
    }
    INFO("targets up to " << largest);
    CHECK(limiter.max_step() == Approx(std::hypot(0.1, 0.4)));
    CHECK(max_step <= limiter.max_step() * (1.0 + 1e-12));
    CHECK(max_force <= 3.3 * (1.0 + 1e-12));
  }
}

TEST_CASE("the in-plane and normal steps have separate limits, 0.1 and 0.4", "[render]") {
  const Vector3d next = limiter.next({0, 0, 0}, {3.0, 4.0, 5.0});
  CHECK(next.head<2>().norm() == Approx(0.1));
  CHECK(next.x() / next.y() == Approx(0.75));
  CHECK(next.z() == Approx(0.4));
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

TEST_CASE("a target above the peak is approached in its direction", "[render]") {
  const Vector3d target(6.0, -8.0, 24.0);
  Vector3d force = Vector3d::Zero();
  for (int i = 0; i < 5000; ++i) force = limiter.next(force, target);
  CHECK(force.isApprox(3.3 * target.normalized()));
  ForceLimiter unlimited{0.1, 0.4, 3.3, false};
  CHECK(unlimited.next({0, 0, 0}, target).isApprox(3.3 * target.normalized()));
}

TEST_CASE("without a rate limit the force follows its target at once", "[render]") {
  ForceLimiter unlimited{0.1, 0.4, 3.3, false};
  CHECK(unlimited.next({0, 0, 0}, {1.0, -2.0, 0.5}) == Vector3d(1.0, -2.0, 0.5));
  CHECK(std::isinf(unlimited.max_step()));
}

TEST_CASE("a force above the requested limit shortens by the full step in every tick, wherever its target is",
          "[render]") {
  Sequence random(13);
  for (const double jerk : {ForceLimiter::no_limit, 0.05, 0.001}) {
    for (int run = 0; run < 200; ++run) {
      ForceLimiter limited{0.1, 0.4, 3.3, true, jerk};
      Vector3d force(0, 0, 0);
      for (int i = 0; i < 200; ++i) force = limited.next(force, random_force(random, 5.0) + Vector3d(3.0, 0, 0));
      double longest = force.norm();
      for (int i = 0; i < 40; ++i) {
        longest -= random.between(0.0, 0.1);
        const Vector3d target = i % 2 ? random_force(random, 5.0) : Vector3d(3.0 * force + random_force(random, 3.0));
        const Vector3d next = limited.next(force, target, std::max(0.0, longest));
        CHECK(next.norm() <= std::max(0.0, longest) + 1e-12);
        CHECK((next - force).norm() <= limited.max_step() * (1.0 + 1e-12));
        force = next;
      }
    }
  }
}

TEST_CASE("a force to be removed at once ramps down by the smaller of the two steps per tick", "[render]") {
  ForceLimiter limited{0.1, 0.4, 3.3, true, 0.01};
  Vector3d force(0, 0, 0);
  for (int i = 0; i < 200; ++i) force = limited.next(force, {1.2, 1.6, 0.0});
  REQUIRE(force.isApprox(Vector3d(1.2, 1.6, 0.0)));
  for (int i = 1; i <= 20; ++i) {
    force = limited.next(force, {1.2, 1.6, 0.0}, 0.0);
    CHECK(force.norm() == Approx(2.0 - 0.1 * i).margin(1e-12));
  }
}

TEST_CASE("with jerk the step changes by at most that, except where the peak or the paper takes precedence",
          "[render]") {
  Sequence random(14);
  for (const double jerk : {0.0003, 0.01, 0.1, 1.0}) {
    ForceLimiter limited{0.1, 0.4, 3.3, true, jerk};
    Vector3d force(0, 0, 0), last_step(0, 0, 0), target(0, 0, 0);
    double in_plane = 0.0, normal = 0.0, max_step = 0.0;
    bool was_shortened = false;
    for (int i = 0; i < 50'000; ++i) {
      if (i % 40 == 0) target = random_force(random, 3.0);
      const Vector3d next = limited.next(force, target);
      const Vector3d step = next - force;
      const bool shortened = next.norm() >= 3.3 * (1.0 - 1e-12) || next.z() == 0.0;  // or clamped: it would pull
      if (!shortened && !was_shortened) {
        in_plane = std::max(in_plane, (step - last_step).head<2>().norm());
        normal = std::max(normal, std::abs(step.z() - last_step.z()));
      }
      max_step = std::max(max_step, step.norm());
      was_shortened = shortened;
      last_step = step;
      force = next;
    }
    INFO("jerk " << jerk);
    CHECK(in_plane <= jerk + 1e-12);
    CHECK(normal <= jerk + 1e-12);
    CHECK(in_plane > 0.9 * std::min(jerk, 0.1));
    CHECK(max_step <= limited.max_step() * (1.0 + 1e-12));
  }
}

TEST_CASE("with jerk a constant target is reached quickly and without overshoot", "[render]") {
  for (const double jerk : {0.001, 0.013, 0.1, 0.5}) {
    for (const double target : {0.0001, 0.0123, 0.7, 3.0}) {
      for (const int axis : {0, 2}) {
        ForceLimiter limited{0.1, 0.4, 3.3, true, jerk};
        const double longest = axis == 0 ? 0.1 : 0.4;
        Vector3d aim(0, 0, 0), force(0, 0, 0);
        aim[axis] = target;
        double furthest = 0.0;
        int ticks = 0;
        while (force != aim && ticks < 10'000) {
          force = limited.next(force, aim);
          furthest = std::max(furthest, force[axis]);
          ++ticks;
        }
        INFO("jerk " << jerk << ", target " << target << ", axis " << axis);
        CHECK(furthest <= target * (1.0 + 1e-12));
        CHECK(force[axis] == Approx(target));
        // At constant acceleration up and down, or up to the maximum step and down from it, plus ticks of rounding.
        const double fastest = std::min(longest, std::sqrt(jerk * target));
        CHECK(ticks <= target / fastest + fastest / jerk + 4.0);
        CHECK(limited.next(force, aim) == force);
      }
    }
  }
}

TEST_CASE("with jerk no target, however it moves, drives the force beyond the limits", "[render]") {
  Sequence random(15);
  for (const double jerk : {1e-6, 0.01, 10.0}) {
    ForceLimiter limited{0.1, 0.4, 3.3, true, jerk};
    Vector3d force(0, 0, 0);
    double max_step = 0.0, max_force = 0.0;
    for (int i = 0; i < 50'000; ++i) {
      Vector3d target = random_force(random, 10.0);
      if (i % 3 == 0) target = -force;
      if (i % 5 == 0) target = 1e100 * random_force(random, 1.0);
      const bool releases = i % 17 == 0;
      const Vector3d next = releases ? limited.release(force) : limited.next(force, target);
      max_step = std::max(max_step, (next - force).norm());
      max_force = std::max(max_force, next.norm());
      force = next;
    }
    INFO("jerk " << jerk);
    CHECK(max_step <= limited.max_step() * (1.0 + 1e-12));
    CHECK(max_force <= 3.3 * (1.0 + 1e-12));
  }
}

TEST_CASE("with jerk a force whose targets all press never pulls", "[render]") {
  Sequence random(16);
  for (const double jerk : {0.001, 0.02, 0.2}) {
    ForceLimiter limited{0.1, 0.4, 3.3, true, jerk};
    Vector3d force(0, 0, 0);
    double least = 0.0, longest = 3.3;
    for (int i = 0; i < 100'000; ++i) {
      Vector3d target = random_force(random, 4.0);
      target.z() = random.next() < 0.5 ? 0.0 : std::abs(target.z());
      if (i % 50 == 0) longest = random.between(0.0, 5.0);
      force = limited.next(force, target, longest);
      least = std::min(least, force.z());
    }
    INFO("jerk " << jerk);
    CHECK(least == 0.0);
  }
}

TEST_CASE("a release ramps straight to zero, in |F| over the maximum step ticks", "[render]") {
  for (const double jerk : {ForceLimiter::no_limit, 0.001}) {
    ForceLimiter limited{0.1, 0.4, 3.3, true, jerk};
    Vector3d force(0, 0, 0);
    for (int i = 0; i < 60; ++i) force = limited.next(force, {2.0, -1.0, 2.5});
    const Vector3d from = force;
    int ticks = 0;
    while (force != Vector3d(0, 0, 0)) {
      const Vector3d next = limited.release(force);
      CHECK(next.cross(from).norm() < 1e-12);
      CHECK(next.dot(from) >= 0.0);
      force = next;
      ++ticks;
    }
    CHECK(ticks == static_cast<int>(std::ceil(from.norm() / limited.max_step())));
    // And the following force starts from rest.
    CHECK(limited.next({0, 0, 0}, {-1.0, 0, 0}).norm() <= std::min(jerk, 0.1) + 1e-12);
  }
}
