// The last stage: no step larger than allowed, none above the peak, direction kept, the target reached.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>

#include <calligraphy/render/force_limiter.hpp>

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

TEST_CASE("no step exceeds the largest step and no force the peak, whatever the targets", "[render]") {
  Sequence random(11);
  for (const double largest : {0.05, 1.0, 3.3, 10.0, 1e6, 1e100}) {
    Vector3d force = Vector3d::Zero();
    double largest_step = 0.0, largest_force = 0.0;
    for (int i = 0; i < 20'000; ++i) {
      Vector3d target = random_force(random, largest);
      if (i % 3 == 0) target = -force;
      if (i % 7 == 0) target = Vector3d(0.0, 0.0, largest);
      const Vector3d next = limiter.next(force, target);
      largest_step = std::max(largest_step, (next - force).norm());
      largest_force = std::max(largest_force, next.norm());
      force = next;
    }
    INFO("targets up to " << largest);
    CHECK(limiter.max_step() == Approx(std::hypot(0.1, 0.4)));
    CHECK(largest_step <= limiter.max_step() * (1.0 + 1e-12));
    CHECK(largest_force <= 3.3 * (1.0 + 1e-12));
  }
}

TEST_CASE("each axis of the limit is its own: in the plane 0.1, along the normal 0.4", "[render]") {
  const Vector3d next = limiter.next({0, 0, 0}, {3.0, 4.0, 5.0});
  CHECK(next.head<2>().norm() == Approx(0.1));
  CHECK(next.x() / next.y() == Approx(0.75));
  CHECK(next.z() == Approx(0.4));
}

TEST_CASE("a target within reach is reached, and stays", "[render]") {
  Sequence random(12);
  for (int i = 0; i < 100; ++i) {
    const Vector3d target = random_force(random, 1.9);
    Vector3d force = random_force(random, 1.9);
    for (int k = 0; k < 60; ++k) force = limiter.next(force, target);
    CHECK(force == target);
  }
}

TEST_CASE("a target above the peak is approached along its direction", "[render]") {
  const Vector3d target(6.0, -8.0, 24.0);
  Vector3d force = Vector3d::Zero();
  for (int i = 0; i < 5000; ++i) force = limiter.next(force, target);
  CHECK(force.norm() == Approx(3.3));
  ForceLimiter unlimited{0.1, 0.4, 3.3, false};
  CHECK(unlimited.next({0, 0, 0}, target).isApprox(3.3 * target.normalized()));
}

TEST_CASE("without a rate limit a force comes at once", "[render]") {
  ForceLimiter unlimited{0.1, 0.4, 3.3, false};
  CHECK(unlimited.next({0, 0, 0}, {1.0, -2.0, 0.5}) == Vector3d(1.0, -2.0, 0.5));
  CHECK(std::isinf(unlimited.max_step()));
}
