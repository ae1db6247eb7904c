// What remains of a budget, and what force that pays for.
#include "../catch.hpp"

#include <cmath>
#include <limits>

#include <calligraphy/render/detail/energy_budget.hpp>
#include <calligraphy/render/detail/energy_observer.hpp>

using namespace calligraphy;
using Eigen::Vector3d;

namespace {

PassivityOptions budget_of(double joules) {
  PassivityOptions options;
  options.energy_budget = joules;
  options.mass = 0.045;
  return options;
}

}  // namespace

TEST_CASE("energy that the hand returns is added to the budget, up to its size", "[render]") {
  EnergyBudget budget(budget_of(0.01), 0.001);
  CHECK(budget.remaining() == 0.01);
  budget.pay(0.004);
  CHECK(budget.remaining() == Approx(0.006));
  budget.pay(-0.003);
  CHECK(budget.remaining() == Approx(0.009));
  budget.pay(-0.009);
  CHECK(budget.remaining() == 0.01);
  budget.pay(0.03);
  CHECK(budget.remaining() == Approx(-0.02));
  budget.restart();
  CHECK(budget.remaining() == 0.01);
}

TEST_CASE("a force whose work no sample has shown is charged at the speed of a hand", "[render]") {
  // F v t + (F t)^2 / (2 m) = E, with t one tick less for each that has passed of the gap.
  const auto payable = [](double energy, double time) {
    const double square = time * time / (2.0 * 0.045), linear = 2.0 * time;
    return (-linear + std::sqrt(linear * linear + 4.0 * square * energy)) / (2.0 * square);
  };
  const PassivityOptions options = budget_of(0.1);
  EnergyObserver observer(options, 0.001);
  EnergyBudget budget(options, 0.001);
  observer.move({0, 0, 0});
  observer.sent({1.0, 0, 0});
  for (int missed = 1; missed <= 3; ++missed) {
    observer.lose_sample();
    budget.limited({5.0, 0, 0}, {0, 0, 0}, observer);
    CHECK(budget.max_force() == Approx(payable(0.1 - 0.0034 - 0.002 * missed, 0.017 - 0.001 * missed)));
    observer.sent({1.0, 0, 0});
  }
}

TEST_CASE("an infinite budget limits nothing", "[render]") {
  EnergyBudget budget(PassivityOptions{}, 0.001);
  budget.pay(1e6);
  CHECK_FALSE(budget.is_limited());
  CHECK(budget.remaining() == std::numeric_limits<double>::infinity());
  CHECK(budget.max_force() == std::numeric_limits<double>::infinity());
}
