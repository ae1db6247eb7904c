#include <calligraphy/model/composition.hpp>

namespace calligraphy {

std::vector<int> feature_points(std::string_view elements, int curve_degree) {
  std::vector<int> indices{0};
  indices.reserve(elements.size() + 1);
  for (const char element : elements) indices.push_back(indices.back() + points_added(element, curve_degree));
  return indices;
}

}  // namespace calligraphy
