// How a curve is divided for its slope ordinates, and where they are stored.
#pragma once

#include <array>
#include <cstddef>

#include <calligraphy/collision/detail/curve_element.hpp>

namespace calligraphy {

using detail::CurveElement;

/// As many cells as fit: each takes 2 * degree - 1 ordinates, and the last takes one more.
constexpr int cells_of_degree(int degree) {
  return (static_cast<int>(CurveElement::max_ordinates) - 1) / (2 * degree - 1);
}

/// Position of ordinate i in memory. Packing the signs of registers of eight interleaves their halves, so the ordinates
/// are stored such that the signs come out in order: each half of a group of registers holds one half of its ordinates.
template <std::size_t Count>
constexpr std::size_t place_of_ordinate(std::size_t i) {
  if (Count == 8) return i;
  const std::size_t group = i / 32 * 32, of_group = i < 32 ? 32 : 16, within = i - group;
  const std::size_t half = within / (of_group / 2), chunk = within % (of_group / 2) / 4;
  return group + 8 * chunk + 4 * half + i % 4;
}

/// Parameter midway between an ordinate and the next.
template <int Degree>
inline constexpr std::array<double, CurveElement::max_ordinates> middles = [] {
  std::array<double, CurveElement::max_ordinates> parameters = {};
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    parameters[i] = (static_cast<double>(i) + 0.5) / ((2 * Degree - 1) * cells_of_degree(Degree));
  }
  return parameters;
}();

}  // namespace calligraphy
