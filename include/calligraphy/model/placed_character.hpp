// A character placed on the page.
#pragma once

#include <span>

#include <Eigen/Geometry>

#include <calligraphy/model/character.hpp>

namespace calligraphy {

/// Maps em coordinates to metres: page point = origin + em * point.
struct Placement {
  Point origin = Point::Zero();  ///< lower left corner of the em square on the page [m]
  double em = 0.04;              ///< edge of the em square, within min_em and max_em [m]

  static constexpr double min_em = 1e-6;  ///< [m]
  static constexpr double max_em = 1e3;   ///< [m]
  /// The furthest that a character may reach from the page's origin, along x or y [m].
  static constexpr double max_coordinate = 1e3;

  /// From em coordinates [em] to the page [m].
  Point to_page(const Point& point) const noexcept { return origin + em * point; }
};

/// A character placed on the page.
struct PlacedCharacter {
  Character character;  ///< its strokes, in em coordinates
  Placement placement;  ///< where its em square lies, and how large it is
};

/// Bounding box of the control points of a character on the page [m].
Eigen::AlignedBox2d bounding_box(const PlacedCharacter& placed);

/// @throws ValueError naming the character of a page that is invalid, or when there is none
void validate(std::span<const PlacedCharacter> page);

}  // namespace calligraphy
