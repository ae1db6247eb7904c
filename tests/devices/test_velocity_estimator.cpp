#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/velocity_estimator.hpp>

#include "../allocation_counter.hpp"
#include "../catch.hpp"
#include "../hard_cases.hpp"
#include "../special_values.hpp"

using namespace calligraphy;
using calligraphy_test::infinity;
using calligraphy_test::not_a_number;
using calligraphy_test::Sequence;
using Eigen::Vector3d;

namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

}  // namespace

TEST_CASE("the estimate of a constant velocity rises like a first-order low-pass, however uneven the samples are",
          "[velocity]") {
  const double cutoff = GENERATE(5.0, 50.0, 400.0);
  const Vector3d velocity(0.3, -0.1, 0.02);
  VelocityEstimator estimator(cutoff);
  CHECK(estimator.update({1.0, 2.0, 3.0}, 1e-3).isZero(0.0));
  double time = 0.0;
  for (int i = 0; i < 50; ++i) {
    const double elapsed = i % 3 == 0 ? 0.2e-3 : i % 7 == 0 ? 20e-3 : 1e-3;
    time += elapsed;
    estimator.update(Vector3d(1.0, 2.0, 3.0) + time * velocity, elapsed);
    REQUIRE((estimator.velocity() - (1.0 - std::exp(-two_pi * cutoff * time)) * velocity).norm() < 1e-9);
  }
}

TEST_CASE("at its cut-off frequency the estimate has fallen by 3 dB and lags by 45 degrees", "[velocity]") {
  constexpr double cutoff = 50.0, period = 1e-6;
  VelocityEstimator estimator;  // 50 Hz by default
  double in_phase = 0.0, quadrature = 0.0;
  constexpr int cycle = 20'000;
  for (int i = 0; i < 4 * cycle; ++i) {
    const double angle = two_pi * cutoff * period * i;
    const double estimate = estimator.update({std::sin(angle) / (two_pi * cutoff), 0.0, 0.0}, period).x();
    if (i < 3 * cycle) continue;  // settles
    in_phase += 2.0 / cycle * estimate * std::cos(angle);
    quadrature += 2.0 / cycle * estimate * std::sin(angle);
  }
  CHECK(std::hypot(in_phase, quadrature) == Approx(std::numbers::sqrt2 / 2.0).epsilon(1e-3));
  CHECK(std::atan2(quadrature, in_phase) == Approx(std::numbers::pi / 4.0).epsilon(1e-3));
}

TEST_CASE("one encoder step moves the estimate by its share of a step per tick, then it decays", "[velocity]") {
  constexpr double step = 23e-6, period = 1e-3;
  VelocityEstimator estimator;
  estimator.update({0.0, 0.0, 0.0}, period);
  const double share = 1.0 - std::exp(-two_pi * 50.0 * period);
  CHECK(estimator.update({step, 0.0, 0.0}, period).x() == Approx(share * step / period));
  CHECK(estimator.update({step, 0.0, 0.0}, period).x() == Approx(share * (1.0 - share) * step / period));
}

TEST_CASE("a lost sample or a clock that stands leaves the estimate, and the next speed is not too high",
          "[velocity]") {
  constexpr double speed = 0.2;
  VelocityEstimator estimator;
  double time = 0.0;
  const auto at = [&] { return Vector3d(0.0, speed * time, 0.0); };
  for (int i = 0; i < 200; ++i, time += 1e-3) estimator.update(at(), 1e-3);
  const Vector3d before = estimator.velocity();
  REQUIRE(before.y() == Approx(speed));
  SECTION("positions that are not finite") {
    for (const double bad : {not_a_number, infinity, -infinity}) {
      time += 1e-3;
      CHECK(estimator.update({0.0, bad, 0.0}, 1e-3) == before);
    }
    CHECK(estimator.update(at(), 1e-3).y() == Approx(speed));
    // The next difference is from the last good position, over both intervals.
    estimator.update({not_a_number, 0.0, 0.0}, 1e-3);
    const double share = 1.0 - std::exp(-two_pi * 50.0 * 2e-3);
    CHECK(estimator.update(at(), 1e-3).y() == Approx((1.0 - share) * speed));
  }
  SECTION("times that are not above zero") {
    for (const double elapsed : {0.0, -1e-3, not_a_number, infinity}) {
      CHECK(estimator.update(at() + Vector3d(0.0, 1.0, 0.0), elapsed) == before);
    }
    CHECK(estimator.update(at(), 1e-3).y() == Approx(speed));
  }
}

TEST_CASE("a clock that jitters or pauses gives the estimate of the exact low-pass", "[velocity]") {
  Sequence random(3);
  for (const double cutoff : {5.0, 50.0, 400.0}) {
    VelocityEstimator estimator(cutoff);
    Vector3d position = Vector3d::Zero(), expected = Vector3d::Zero();
    estimator.update(position, 1e-3);
    double largest = 0.0;
    for (int i = 0; i < 20'000; ++i) {
      double elapsed = 1e-3 + random.between(-40e-6, 40e-6);
      if (i % 500 == 250) elapsed = random.between(1e-6, 20e-3);  // from then on the share is that of this interval
      const Vector3d way(random.between(-1e-4, 1e-4), random.between(-1e-4, 1e-4), random.between(-1e-4, 1e-4));
      position += way;
      expected += -std::expm1(-two_pi * cutoff * elapsed) * (way / elapsed - expected);
      largest = std::max(largest, (estimator.update(position, elapsed) - expected).norm());
    }
    CHECK(largest <= 1e-11);  // of 0.1 m/s and 1e-4 m a sample, whose differences round to 1e-13 m/s
  }
}

TEST_CASE("a restarted estimator gives the same bits again, whatever intervals were before", "[velocity]") {
  const auto estimates = [](VelocityEstimator& estimator) {
    std::vector<Vector3d> all;
    for (int i = 0; i < 20; ++i) all.push_back(estimator.update({1e-4 * i * i, 0.0, 0.0}, 1e-3 + 1e-6 * (i % 7)));
    return all;
  };
  VelocityEstimator fresh, used;
  for (int i = 0; i < 10; ++i) used.update({0.01 * i, 0.0, 0.0}, 1.013e-3);
  used.restart();
  CHECK(estimates(fresh) == estimates(used));
}

TEST_CASE("a restarted estimator has forgotten where the point was", "[velocity]") {
  VelocityEstimator estimator;
  for (int i = 0; i < 10; ++i) estimator.update({0.01 * i, 0.0, 0.0}, 1e-3);
  REQUIRE(estimator.velocity().x() > 1.0);
  estimator.restart();
  CHECK(estimator.velocity().isZero(0.0));
  CHECK(estimator.update({5.0, 5.0, 5.0}, 0.0).isZero(0.0));
  CHECK(estimator.update({5.0, 5.0, 5.0}, 1e-3).isZero(0.0));
}

TEST_CASE("the estimate stays finite whatever the positions are", "[velocity]") {
  VelocityEstimator estimator;
  const std::size_t before = calligraphy_test::allocations();
  bool finite = true;
  for (int i = 0; i < 100; ++i) {
    const double place = i % 2 == 0 ? 1.7e308 : -1.7e308;
    finite = finite && estimator.update({place, 0.0, -place}, i % 5 == 0 ? 1e-300 : 1e-3).allFinite();
  }
  const std::size_t after = calligraphy_test::allocations();
  CHECK(finite);
  for (int i = 0; i < 1000; ++i) estimator.update({0.1, 0.1, 0.1}, 1e-3);
  CHECK(estimator.velocity().norm() < 1e-9);
  CHECK(after == before);
}

TEST_CASE("a cut-off frequency that is not finite and above zero is refused by its value", "[velocity]") {
  for (const double cutoff : {0.0, -1.0, not_a_number, infinity}) {
    CAPTURE(cutoff);
    CHECK_THROWS_AS(VelocityEstimator(cutoff), ValueError);
  }
  CHECK_THROWS_WITH(VelocityEstimator(-1.0), "cut-off frequency of the velocity = -1 Hz, must be finite and above 0");
}
