// The heat of the motors in closed form, and the force that it permits.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <calligraphy/render/detail/thermal_budget.hpp>

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

TEST_CASE("the limit is the peak up to four fifths of the heat, and the continuous force from full heat on",
          "[render]") {
  ThermalBudget budget = omni();
  for (const double heat : {0.0, 0.5, 0.8}) {
    budget.heat = heat;
    CHECK(budget.max_force() == Approx(3.3));
  }
  budget.heat = 0.9;
  CHECK(budget.max_force() == Approx(0.5 * (3.3 + 0.88)));
  for (const double heat : {1.0, 1.5, 100.0}) {
    budget.heat = heat;
    CHECK(budget.max_force() == Approx(0.88));
  }
}

TEST_CASE("saturated for a minute, the force falls from the peak to the continuous one without a step", "[render]") {
  ThermalBudget budget = omni();
  const std::vector<double> forces = saturated(budget, 60.0);
  CHECK(forces.front() == Approx(3.3));
  double max_fall = 0.0, max_rise = 0.0;
  for (std::size_t i = 1; i < forces.size(); ++i) {
    max_fall = std::max(max_fall, forces[i - 1] - forces[i]);
    max_rise = std::max(max_rise, forces[i] - forces[i - 1]);
  }
  CHECK(max_rise == 0.0);
  CHECK(forces.back() == Approx(0.88).epsilon(0.02));
  CHECK(forces.back() >= 0.88);
  CHECK(budget.heat <= 1.0);
  // d limit / dt = 5 (peak - continuous) dh / dt, and dh / dt is at most (peak / continuous)^2 / tau.
  CHECK(max_fall <= 5.0 * (3.3 - 0.88) * std::pow(3.3 / 0.88, 2) / time_constant * 0.001 * (1.0 + 1e-9));
  // The peak lasts until (peak / continuous)^2 (1 - exp(-t / tau)) = 0.8.
  const double warm = -time_constant * std::log(1.0 - 0.8 / std::pow(3.3 / 0.88, 2));
  const auto first_below = std::find_if(forces.begin(), forces.end(), [](double force) { return force < 3.3 - 1e-9; });
  CHECK(0.001 * static_cast<double>(first_below - forces.begin()) == Approx(warm).margin(0.002));
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

TEST_CASE("motors at rest cool by exp(-t / tau), and the peak returns", "[render]") {
  ThermalBudget budget = omni();
  saturated(budget, 60.0);
  const double hot = budget.heat;
  double last = budget.max_force(), max_step = 0.0;
  bool rises = true;
  for (int i = 0; i < 5000; ++i) {
    budget.held(0.0, 0.001);
    rises = rises && budget.max_force() >= last;
    max_step = std::max(max_step, budget.max_force() - last);
    last = budget.max_force();
  }
  CHECK(budget.heat == Approx(hot * std::exp(-0.5)));
  CHECK(rises);
  CHECK(max_step <= 5.0 * (3.3 - 0.88) / time_constant * 0.001 * (1.0 + 1e-9));
  CHECK(last == Approx(3.3));
}
