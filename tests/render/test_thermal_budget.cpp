// The heat of the motors in closed form, and the force that it permits.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <calligraphy/base/random.hpp>

#include "render/thermal_budget.hpp"

using namespace calligraphy;

namespace {

constexpr double time_constant = 10.0;

ThermalBudget omni() { return {3.3, 0.88, time_constant, 0.0}; }

/// The force of each tick while saturated.
std::vector<double> saturated(ThermalBudget& budget, double seconds, double period = 0.001) {
  std::vector<double> forces;
  for (int i = 0; i < static_cast<int>(std::lround(seconds / period)); ++i) {
    forces.push_back(budget.max_force());
    budget.held(forces.back(), period);
  }
  return forces;
}

}  // namespace

TEST_CASE("heat under a held force is (F / continuous)^2 (1 - exp(-t / tau)), whatever the rate", "[render]") {
  for (const double force : {0.2, 0.88, 3.3}) {
    for (const double period : {0.01, 0.001, 0.00005}) {
      ThermalBudget budget = omni();
      const double seconds = 3.0;
      for (int i = 0; i < static_cast<int>(std::lround(seconds / period)); ++i) budget.held(force, period);
      const double balance = std::pow(force / 0.88, 2);
      CHECK(budget.heat == Approx(balance * (1.0 - std::exp(-seconds / time_constant))));
    }
  }
}

TEST_CASE("a force held for one long interval heats like one held tick by tick", "[render]") {
  ThermalBudget at_once = omni(), by_ticks = omni();
  at_once.held(2.0, 7.0);
  for (int i = 0; i < 7000; ++i) by_ticks.held(2.0, 0.001);
  CHECK(at_once.heat == Approx(by_ticks.heat));
}

TEST_CASE("held at the limit, cold motors give twice the continuous force, which sinks by a tenth per second to it",
          "[render]") {
  // With F = c (1 + sqrt(1 - h)) and tau dh/dt = (F / c)^2 - h: dF/dt = -F / tau, until F = c.
  ThermalBudget budget = omni();
  const std::vector<double> forces = saturated(budget, 60.0);
  double max_error = 0.0;
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const double expected = std::max(0.88, 1.76 * std::exp(-0.001 * static_cast<double>(i) / time_constant));
    max_error = std::max(max_error, std::abs(forces[i] - expected));
  }
  CHECK(max_error < 0.001 * 1.76);
  CHECK(budget.heat <= 1.0 + 1e-7);
}

TEST_CASE("whatever force is wanted, the permitted one never sinks faster than by its share per time constant, and the "
          "heat stays below that of the continuous force",
          "[render]") {
  calligraphy::Random random(5);
  for (const double peak : {1.0, 1.5, 3.3, std::numeric_limits<double>::infinity()}) {
    ThermalBudget budget{peak, 0.88, time_constant, 0.0};
    double wanted = 0.0, fastest = 0.0, hottest = 0.0;
    std::vector<double> permitted = {budget.max_force()};
    CHECK(permitted.front() == std::min(peak, 1.76));
    for (int i = 0; i < 200'000; ++i) {
      if (random.next() < 0.002) wanted = random.next() < 0.3 ? 0.0 : random.between(0.0, 4.0);
      budget.held(std::min(wanted, budget.max_force()), 0.001);
      permitted.push_back(budget.max_force());
      hottest = std::max(hottest, budget.heat);
    }
    for (std::size_t i = 50; i < permitted.size(); ++i) {
      fastest = std::max(fastest, (permitted[i - 50] - permitted[i]) / permitted[i - 50] / 0.05);
    }
    CAPTURE(peak);
    CHECK(fastest <= 1.1 / time_constant);  // a tick more where it arrives
    CHECK(hottest <= 1.0 + 1e-7);
    CHECK(hottest > 0.99);
  }
}

TEST_CASE("over any window the RMS force is at most the continuous one, plus what warms cold motors", "[render]") {
  // tau dh/dt = (F / continuous)^2 - h with h at most 1 gives mean(F^2) <= continuous^2 (1 + tau / window).
  ThermalBudget budget = omni();
  const std::vector<double> forces = saturated(budget, 150.0, 0.01);
  std::vector<double> squares = {0.0};
  for (const double force : forces) squares.push_back(squares.back() + force * force);
  for (const std::size_t window : {500u, 2000u, 10'000u}) {
    const double seconds = 0.01 * static_cast<double>(window);
    double largest = 0.0, max_warm = 0.0;
    for (std::size_t i = 0; i + window < squares.size(); i += 10) {
      const double square = (squares[i + window] - squares[i]) / static_cast<double>(window);
      largest = std::max(largest, square);
      if (i >= 4000) max_warm = std::max(max_warm, square);
    }
    INFO("window " << seconds << " s");
    CHECK(largest <= 0.88 * 0.88 * (1.0 + time_constant / seconds));
    CHECK(max_warm <= 0.88 * 0.88 * 1.05);
  }
}

TEST_CASE("motors at rest cool by exp(-t / tau), and the permitted force returns", "[render]") {
  ThermalBudget budget = omni();
  saturated(budget, 60.0);
  CHECK(budget.is_warm());
  const double hot = budget.heat;
  double last = budget.max_force();
  bool rises = true;
  for (int i = 0; i < 5000; ++i) {
    budget.held(0.0, 0.001);
    rises = rises && budget.max_force() >= last;
    last = budget.max_force();
  }
  CHECK(budget.heat == Approx(hot * std::exp(-0.5)));
  CHECK(rises);
  CHECK(last == Approx(0.88 * (1.0 + std::sqrt(1.0 - std::exp(-0.5)))).epsilon(1e-3));
  budget.held(0.0, 20.0);
  CHECK_FALSE(budget.is_warm());  // 4 % less than cold motors may do
}
