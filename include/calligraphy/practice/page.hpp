// Characters laid out in rows on pages that fit a device's workspace.
#pragma once

#include <span>
#include <vector>

#include <calligraphy/collision/placed_character.hpp>

namespace calligraphy {

struct PageLayout {
  double width = 0.16;   ///< [m]
  double height = 0.12;  ///< [m]
  double em = 0.04;      ///< edge of a character's square [m]
  double gap = 0.008;    ///< between squares, and round them [m]
};

struct PracticePage {
  double width = 0.0;   ///< [m]
  double height = 0.0;  ///< [m]
  std::vector<PlacedCharacter> characters;
};

/// Left to right, top to bottom, as many pages as it takes, the rows centred on each page.
/// @throws ValueError when a length is not a positive number or not one square fits
std::vector<PracticePage> lay_out(std::span<const Character> characters, const PageLayout& layout = {});

}  // namespace calligraphy
