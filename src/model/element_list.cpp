#include <calligraphy/model/element_list.hpp>

#include <string>

#include <calligraphy/base/error.hpp>

namespace calligraphy {

constexpr std::array<std::array<char, max_elements_per_stroke>, ElementList::lists_> ElementList::all_ = [] {
  std::array<std::array<char, max_elements_per_stroke>, lists_> all{};
  for (std::size_t curves = 0; curves < lists_; ++curves) {
    for (std::size_t i = 0; i < all[curves].size(); ++i) {
      all[curves][i] = static_cast<char>(((curves >> i) & 1) != 0 ? ElementKind::curve : ElementKind::line);
    }
  }
  return all;
}();

void ElementList::refuse(std::string_view elements) {
  throw ValueError("elements '" + std::string(elements.substr(0, 20)) + "': expected at most " +
                   std::to_string(max_elements_per_stroke) + " of L (line) and C (curve)");
}

std::vector<int> feature_points(ElementList elements, int curve_degree) {
  std::vector<int> indices{0};
  indices.reserve(elements.size() + 1);
  for (std::size_t i = 0; i < elements.size(); ++i) {
    indices.push_back(indices.back() + (((elements.curves() >> i) & 1) != 0 ? curve_degree : 1));
  }
  return indices;
}

}  // namespace calligraphy
