// Compositions as files store them (docs/set-file.md, docs/character-format.md).
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include <calligraphy/model/typical_stroke.hpp>

namespace calligraphy {

/// Which elements are curves, the first one in the lowest bit.
constexpr unsigned curves_in(std::string_view elements) noexcept {
  unsigned curves = 0;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (elements[i] == static_cast<char>(ElementKind::curve)) curves |= 1U << i;
  }
  return curves;
}

/// The inverse of curves_in(), for up to max_elements_per_stroke elements; in static storage.
inline std::string_view element_list(std::size_t count, unsigned curves) noexcept {
  constexpr std::size_t lists = std::size_t{1} << max_elements_per_stroke;
  static constexpr auto table = [] {
    std::array<std::array<char, max_elements_per_stroke>, lists> all{};
    for (std::size_t list = 0; list < lists; ++list) {
      for (std::size_t i = 0; i < all[list].size(); ++i) {
        all[list][i] = static_cast<char>(((list >> i) & 1) != 0 ? ElementKind::curve : ElementKind::line);
      }
    }
    return all;
  }();
  return {table[curves % lists].data(), count};
}

/// Composition of every stroke of this type in a file of format 1, which does not store it.
constexpr std::string_view elements_of_format_1(const TypicalStroke& type) noexcept {
  return type.printed_elements.empty() ? type.elements : type.printed_elements;
}

}  // namespace calligraphy
