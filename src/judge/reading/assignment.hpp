// Who gets what, at the least cost in all.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace calligraphy {

/// For each row the column it is given, or none. `costs[row][column]`; a row left without costs `unmatched`, and so
/// does a column that no row is given. The least sum there is (Kuhn 1955, Munkres 1957, with potentials as Jonker and
/// Volgenant 1987). O(rows^2 (rows + columns)).
std::vector<std::optional<std::size_t>> assign(const std::vector<std::vector<double>>& costs, std::size_t columns,
                                               double unmatched);

}  // namespace calligraphy
