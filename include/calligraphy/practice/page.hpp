// Pages of characters, laid out in rows to fit the workspace of a device.
#pragma once

#include <span>
#include <vector>

#include <calligraphy/collision/placed_character.hpp>
#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/render/motion_mapping.hpp>

namespace calligraphy {

struct PageLayout {
  double width = 0.16;   ///< [m]
  double height = 0.12;  ///< [m]
  double em = 0.04;      ///< edge length of a character's square [m]
  double gap = 0.008;    ///< between and around the squares [m]
};

/// The layout that fills the workspace of a device, given the rotation and the scale K_S of a mapping: the extents of
/// the workspace along the page's axes, that is along x and y of the device if the page is upright, along x and z on a
/// desk, times K_S. Squares are of the usual size, or smaller where not one of them would fit.
PageLayout workspace_layout(const Capabilities& device, const MotionMapping& mapping = {});

struct PracticePage {
  double width = 0.0;   ///< [m]
  double height = 0.0;  ///< [m]
  std::vector<PlacedCharacter> characters;
};

/// Lays the characters out from left to right and top to bottom on as many pages as needed, the rows centred on each.
/// @throws ValueError when a length is not a positive number or no square fits
std::vector<PracticePage> lay_out(std::span<const Character> characters, const PageLayout& layout = {});

}  // namespace calligraphy
