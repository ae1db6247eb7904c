// What remains of a budget, and what force that pays for.
#include "../catch.hpp"

#include <cmath>
#include <limits>

#include <calligraphy/render/detail/energy_budget.hpp>
#include <calligraphy/render/detail/energy_observer.hpp>

namespace energy_budget_tests {

using namespace calligraphy;
using Eigen::Vector3d;

namespace {

PassivityOptions budget_of(double joules) {
  PassivityOptions options;
  options.energy_budget = joules;
  options.mass = 0.045;
  return options;
}

/// F with F v t + (F t)^2 / (2 m) = E, for the hand's 2 m/s and the 45 g of budget_of().
double payable(double energy, double time) {
  const double square = time * time / (2.0 * 0.045), linear = 2.0 * time;
  return (-linear + std::sqrt(linear * linear + 4.0 * square * energy)) / (2.0 * square);
}

constexpr double reserve = 0.0034;  ///< for the brake: 0.1 N over 2 m/s for 17 ms [J]

}  // namespace

TEST_CASE("energy that the hand returns is added to the budget, up to its size", "[render]") {
  EnergyBudget budget(budget_of(0.1), 0.001);
  EnergyObserver observer(budget_of(0.1), 0.001);
  observer.move({0, 0, 0});
  const auto remains = [&](double energy) {
    budget.limited({9.0, 0, 0}, {0, 0, 0}, observer);
    return budget.max_force() == Approx(payable(energy - reserve, 0.017));
  };
  CHECK(remains(0.1));
  budget.pay(0.04);
  CHECK(remains(0.06));
  budget.pay(-0.03);
  CHECK(remains(0.09));
  budget.pay(-0.09);
  CHECK(remains(0.1));
  budget.pay(0.3);
  budget.limited({9.0, 0, 0}, {0, 0, 0}, observer);
  CHECK(budget.max_force() == Approx(0.02));  // overdrawn: the faint brake
  budget.restart();
  CHECK(remains(0.1));
}

TEST_CASE("a force whose work no sample has shown is charged at the speed of a hand", "[render]") {
  const PassivityOptions options = budget_of(0.1);
  EnergyObserver observer(options, 0.001);
  EnergyBudget budget(options, 0.001);
  observer.move({0, 0, 0});
  observer.sent({1.0, 0, 0});
  for (int missed = 1; missed <= 3; ++missed) {
    observer.lose_sample();
    budget.limited({5.0, 0, 0}, {0, 0, 0}, observer);
    // The gap foreseen is shorter by what has passed of it.
    CHECK(budget.max_force() == Approx(payable(0.1 - reserve - 0.002 * missed, 0.017 - 0.001 * missed)));
    observer.sent({1.0, 0, 0});
  }
}

TEST_CASE("an infinite budget limits nothing", "[render]") {
  EnergyBudget budget(PassivityOptions{}, 0.001);
  budget.pay(1e6);
  CHECK_FALSE(budget.is_limited());
  CHECK(budget.max_force() == std::numeric_limits<double>::infinity());
}

}  // namespace energy_budget_tests
