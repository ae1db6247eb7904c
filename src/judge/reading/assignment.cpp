#include "assignment.hpp"

#include <limits>

namespace calligraphy {

std::vector<std::optional<std::size_t>> assign(const std::vector<std::vector<double>>& costs, std::size_t columns,
                                               double unmatched) {
  const std::size_t rows = costs.size();
  // A row without a column is assigned to one of its own. A column with a row saves what it would cost alone.
  const std::size_t width = columns + rows;
  const auto cost = [&](std::size_t row, std::size_t column) {
    return column < columns ? costs[row][column] - unmatched : unmatched;
  };
  constexpr double infinite = std::numeric_limits<double>::infinity();
  // Rows and columns count from 1; row 0 is the one being placed.
  std::vector<double> row_potential(rows + 1, 0.0), column_potential(width + 1, 0.0);
  std::vector<std::size_t> row_of(width + 1, 0), before(width + 1, 0);
  for (std::size_t placed = 1; placed <= rows; ++placed) {
    std::vector<double> slack(width + 1, infinite);
    std::vector<bool> visited(width + 1, false);
    std::size_t column = 0;
    row_of[0] = placed;
    do {
      visited[column] = true;
      const std::size_t row = row_of[column];
      double least = infinite;
      std::size_t next = 0;
      for (std::size_t j = 1; j <= width; ++j) {
        if (visited[j]) continue;
        const double reduced = cost(row - 1, j - 1) - row_potential[row] - column_potential[j];
        if (reduced < slack[j]) {
          slack[j] = reduced;
          before[j] = column;
        }
        if (slack[j] < least) {
          least = slack[j];
          next = j;
        }
      }
      for (std::size_t j = 0; j <= width; ++j) {
        if (visited[j]) {
          row_potential[row_of[j]] += least;
          column_potential[j] -= least;
        } else {
          slack[j] -= least;
        }
      }
      column = next;
    } while (row_of[column] != 0);
    for (; column != 0; column = before[column]) row_of[column] = row_of[before[column]];
  }
  std::vector<std::optional<std::size_t>> result(rows);
  for (std::size_t j = 1; j <= columns; ++j) {
    if (row_of[j] != 0) result[row_of[j] - 1] = j - 1;
  }
  return result;
}

}  // namespace calligraphy
