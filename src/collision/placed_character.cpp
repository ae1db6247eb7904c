#include <calligraphy/collision/placed_character.hpp>

namespace calligraphy {

Eigen::AlignedBox2d bounding_box(const PlacedCharacter& placed) {
  Eigen::AlignedBox2d box;
  for (const Point& point : placed.character.structure.control_points) box.extend(placed.placement.to_page(point));
  return box;
}

}  // namespace calligraphy
