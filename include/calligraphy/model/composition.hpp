// The composition of a stroke: its elements, in writing order (Wang 2006, sec. 3.2, 3.4).
#pragma once

#include <string_view>
#include <vector>

namespace calligraphy {

/// Kind of a stroke element (Wang 2006, sec. 3.2): line segment (LSE) or Bezier curve segment (CSE).
enum class ElementKind : char { line = 'L', curve = 'C' };

/// A stroke of any composition, quartic curves included, fits in storage of this size.
inline constexpr int max_elements_per_stroke = 5;
inline constexpr int max_curve_degree = 4;
inline constexpr int max_control_points_per_stroke = max_elements_per_stroke * max_curve_degree + 1;

/// Control points that an element adds: it shares its first one with the element before it.
constexpr int points_added(char element, int curve_degree) {
  return element == static_cast<char>(ElementKind::line) ? 1 : curve_degree;
}

/// Number of control points of a stroke with these elements ("LCL") and curves of the given degree: 3 by default, 4 as
/// printed in eq. (1).
constexpr int control_point_count(std::string_view elements, int curve_degree = 3) {
  int count = 1;
  for (const char element : elements) count += points_added(element, curve_degree);
  return count;
}

/// Number of feature points of a stroke with these elements: one more than elements.
constexpr int feature_point_count(std::string_view elements) { return static_cast<int>(elements.size()) + 1; }

/// Indices of the feature points among the control points of a stroke (Wang 2006, sec. 3.4).
std::vector<int> feature_points(std::string_view elements, int curve_degree = 3);

}  // namespace calligraphy
