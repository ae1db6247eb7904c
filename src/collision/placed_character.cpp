#include <calligraphy/collision/placed_character.hpp>

#include <cstddef>

namespace calligraphy {

std::vector<StrokeElement> place_elements(const Stroke& stroke, const Placement& placement) {
  std::vector<StrokeElement> elements;
  const std::vector<int> ends = feature_points(stroke.elements, stroke.curve_degree);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    std::vector<Point> points;
    for (int k = ends[i]; k <= ends[i + 1]; ++k) {
      points.push_back(placement.to_page(stroke.control_points[static_cast<std::size_t>(k)]));
    }
    elements.push_back(prepare_element(points));
  }
  return elements;
}

Eigen::AlignedBox2d bounding_box(const PlacedCharacter& placed) {
  Eigen::AlignedBox2d box;
  for (const Point& point : placed.character.structure.control_points) box.extend(placed.placement.to_page(point));
  return box;
}

}  // namespace calligraphy
