// Pages of characters, laid out in rows to fit the workspace of a device.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include <calligraphy/devices/capabilities.hpp>
#include <calligraphy/model/placed_character.hpp>
#include <calligraphy/render/motion_mapping.hpp>

namespace calligraphy {

/// Size of a page, and of the squares on it.
struct PageLayout {
  double width = 0.16;   ///< width of the page [m]
  double height = 0.12;  ///< height of the page [m]
  double em = 0.04;      ///< edge length of a character's square [m]
  double gap = 0.008;    ///< between the squares, and between them and the edge of the page [m]
};

/// Layout that fills the workspace of a device, given the rotation and the scale K_S of a mapping. Its size is the
/// extent of the workspace along the page's axes (x and y of the device for an upright page, x and z on a desk) times
/// K_S. Squares have the default size, or less if not even one would fit.
PageLayout workspace_layout(const Capabilities& device, const MotionMapping& mapping = {});

/// A page of placed characters.
struct PracticePage {
  double width = 0.0;                       ///< width of the paper, from its lower left corner [m]
  double height = 0.0;                      ///< height of the paper, from its lower left corner [m]
  std::vector<PlacedCharacter> characters;  ///< in the order in which they are to be written
};

/// Checksum of the characters of a page, the shapes of their strokes and their positions. Two pages that differ share
/// it by chance once in four billion times. Never 0.
std::uint32_t page_id(const PracticePage& page);

/// Lays the characters out from left to right and top to bottom on as many pages as needed, with the rows centred.
/// @throws ValueError when a length is not a positive number or no square fits
std::vector<PracticePage> lay_out(std::span<const Character> characters, const PageLayout& layout = {});
/// The same for characters in braces: lay_out({character}).
inline std::vector<PracticePage> lay_out(std::initializer_list<Character> characters, const PageLayout& layout = {}) {
  return lay_out(std::span(characters.begin(), characters.size()), layout);
}

}  // namespace calligraphy
