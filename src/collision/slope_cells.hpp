// How a curve is cut for its slope ordinates.
#pragma once

#include <calligraphy/collision/curve_element.hpp>

namespace calligraphy {

/// As many as fit: each takes 2 * degree - 1 ordinates, and one more ends the last.
constexpr int cells_of_degree(int degree) {
  return (static_cast<int>(CurveElement::max_ordinates) - 1) / (2 * degree - 1);
}

/// Parameter between neighbouring ordinates of the cells.
template <int Degree>
inline constexpr double ordinate_spacing = 1.0 / ((2 * Degree - 1) * cells_of_degree(Degree));

}  // namespace calligraphy
