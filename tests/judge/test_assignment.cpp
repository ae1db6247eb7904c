#include <algorithm>
#include <limits>
#include <vector>

#include <judge/reading/assignment.hpp>

#include "../catch.hpp"
#include "../hard_cases.hpp"

using namespace calligraphy;

namespace {

using Costs = std::vector<std::vector<double>>;

double sum(const Costs& costs, std::size_t columns, double unmatched,
           const std::vector<std::optional<std::size_t>>& chosen) {
  double total = unmatched * static_cast<double>(columns);
  for (std::size_t row = 0; row < costs.size(); ++row) {
    total += chosen[row] ? costs[row][*chosen[row]] - unmatched : unmatched;
  }
  return total;
}

/// Tries every assignment.
double least(const Costs& costs, std::size_t columns, double unmatched, std::size_t row, std::vector<bool>& taken) {
  if (row == costs.size()) {
    return unmatched * static_cast<double>(std::count(taken.begin(), taken.end(), false));
  }
  double best = unmatched + least(costs, columns, unmatched, row + 1, taken);
  for (std::size_t column = 0; column < columns; ++column) {
    if (taken[column]) continue;
    taken[column] = true;
    best = std::min(best, costs[row][column] + least(costs, columns, unmatched, row + 1, taken));
    taken[column] = false;
  }
  return best;
}

}  // namespace

TEST_CASE("an assignment has the minimum cost of all assignments", "[judge]") {
  calligraphy_test::Sequence random(3);
  for (int run = 0; run < 400; ++run) {
    const auto rows = static_cast<std::size_t>(random.between(0, 6)),
               columns = static_cast<std::size_t>(random.between(0, 6));
    Costs costs(rows, std::vector<double>(columns));
    for (auto& row : costs) {
      for (double& cost : row) cost = random.next() < 0.2 ? 1e3 : random.next() < 0.2 ? 0.5 : random.next();
    }
    const double unmatched = random.between(0.05, 1.0);
    const auto chosen = assign(costs, columns, unmatched);
    REQUIRE(chosen.size() == rows);
    std::vector<bool> used(columns, false);
    for (const auto& column : chosen) {
      if (!column) continue;
      REQUIRE(*column < columns);
      CHECK_FALSE(used[*column]);
      used[*column] = true;
    }
    std::vector<bool> taken(columns, false);
    CHECK(sum(costs, columns, unmatched, chosen) == Approx(least(costs, columns, unmatched, 0, taken)).margin(1e-12));
  }
}
