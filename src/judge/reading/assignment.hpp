// Assignment of rows to columns at the least total cost.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace calligraphy {

/// The column assigned to each row, if any, at the least sum of `costs[row][column]`; each row without a column and
/// each column without a row costs `unmatched` (Kuhn 1955, Munkres 1957, with potentials as in Jonker and Volgenant
/// 1987). O(rows^2 (rows + columns)).
std::vector<std::optional<std::size_t>> assign(const std::vector<std::vector<double>>& costs, std::size_t columns,
                                               double unmatched);

}  // namespace calligraphy
