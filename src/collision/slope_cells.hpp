// How a curve is divided for its slope ordinates, and where they are stored.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <calligraphy/collision/nearest_point.hpp>

namespace calligraphy {

using detail::CurveElement;

/// As many cells as fit: each takes 2 * degree - 1 ordinates, and the last takes one more.
constexpr int cells_of_degree(int degree) {
  return (static_cast<int>(CurveElement::max_ordinates) - 1) / (2 * degree - 1);
}

/// Whether no cell contains two of these sign changes.
template <int Degree>
[[gnu::always_inline]] inline bool one_change_per_cell(std::uint64_t changes) {
  constexpr int per_cell = 2 * Degree - 1;
  // Bits d places above another one of the same cell, for every d.
  constexpr auto within_cell = [](int d) {
    std::uint64_t mask = 0;
    for (int i = 0; i < static_cast<int>(CurveElement::max_ordinates); ++i) {
      mask |= static_cast<std::uint64_t>(i % per_cell >= d) << i;
    }
    return mask;
  };
  static constexpr auto masks = [within_cell] {
    std::array<std::uint64_t, per_cell> all = {};
    for (int d = 1; d < per_cell; ++d) all[static_cast<std::size_t>(d)] = within_cell(d);
    return all;
  }();
  std::uint64_t second = 0;
  for (int d = 1; d < per_cell; ++d) second |= (changes << d) & masks[static_cast<std::size_t>(d)];
  return (changes & second) == 0;
}

/// Parameters of the cell of this sign change.
template <int Degree>
[[gnu::always_inline]] inline ParameterRange cell_of(int change) {
  constexpr double width = 1.0 / cells_of_degree(Degree);
  const int cell = change / (2 * Degree - 1);
  return {cell * width, (cell + 1) * width};
}

template <int Degree>
[[gnu::always_inline]] inline bool in_cell(int change, double t) {
  const ParameterRange cell = cell_of<Degree>(change);
  return t >= cell.begin && t <= cell.end;
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

/// Parameter midway between ordinate i - 1 and ordinate i. The first and the last are never used, but read.
template <int Degree>
inline constexpr std::array<double, CurveElement::max_ordinates + 1> middles = [] {
  std::array<double, CurveElement::max_ordinates + 1> parameters = {};
  for (std::size_t i = 1; i < parameters.size(); ++i) {
    parameters[i] = (static_cast<double>(i) - 0.5) / ((2 * Degree - 1) * cells_of_degree(Degree));
  }
  return parameters;
}();

}  // namespace calligraphy
