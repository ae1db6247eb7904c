// The composition of a stroke: its elements, in writing order (Wang 2006, sec. 3.2, 3.4).
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace calligraphy {

/// Kind of a stroke element (Wang 2006, sec. 3.2): line segment (LSE) or Bezier curve segment (CSE).
enum class ElementKind : char {
  line = 'L',  ///< LSE: two control points
  curve = 'C'  ///< CSE: one more control point than its degree
};

/// Maximum number of elements of a stroke: that of the typical strokes with the most.
inline constexpr int max_elements_per_stroke = 5;
/// Maximum degree of a curve of a character: the quartics printed in eq. (1).
inline constexpr int max_curve_degree = 4;
/// Maximum number of control points of a stroke, whatever its composition.
inline constexpr int max_control_points_per_stroke = max_elements_per_stroke * max_curve_degree + 1;

/// Up to five elements, each a line or a curve; written as "LCL". Takes two bytes, as characters have many.
class ElementList {
 public:
  /// No elements: stands for the composition of the typical stroke.
  constexpr ElementList() = default;
  /// From letters, one per element. @throws ValueError unless there are at most five, all 'L' or 'C'
  constexpr ElementList(std::string_view elements) {
    size_ = static_cast<std::uint8_t>(elements.size());
    if (elements.size() > max_elements_per_stroke) refuse(elements);
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const bool is_curve = elements[i] == static_cast<char>(ElementKind::curve);
      if (!is_curve && elements[i] != static_cast<char>(ElementKind::line)) refuse(elements);
      if (is_curve) curves_ = static_cast<std::uint8_t>(curves_ | 1U << i);
    }
  }
  /// From a literal: "LCL". @throws ValueError as above
  constexpr ElementList(const char* elements) : ElementList(std::string_view(elements)) {}
  /// The same from a string. @throws ValueError as above
  ElementList(const std::string& elements) : ElementList(std::string_view(elements)) {}
  /// `size` elements, of which element i is a curve if bit i of `curves` is set.
  static constexpr ElementList of(std::size_t size, unsigned curves) noexcept {
    ElementList result;
    result.size_ = static_cast<std::uint8_t>(size);
    result.curves_ = static_cast<std::uint8_t>(curves);
    return result;
  }

  /// Number of elements.
  constexpr std::size_t size() const noexcept { return size_; }
  /// Whether there are no elements, which stands for those of the typical stroke.
  constexpr bool empty() const noexcept { return size_ == 0; }
  /// Which elements are curves, the first one in the lowest bit.
  constexpr unsigned curves() const noexcept { return curves_; }
  /// "LCL", in static storage.
  std::string_view elements() const noexcept { return {all_[curves_].data(), size_}; }
  /// Whether they have the same elements in the same order.
  bool operator==(const ElementList&) const = default;

 private:
  [[noreturn]] static void refuse(std::string_view elements);

  static constexpr std::size_t lists_ = std::size_t{1} << max_elements_per_stroke;
  /// By curves(), each with the maximum number of elements.
  static const std::array<std::array<char, max_elements_per_stroke>, lists_> all_;

  std::uint8_t size_ = 0;
  std::uint8_t curves_ = 0;
};

/// Number of control points of a stroke with these elements and curves of the given degree: 3 by default, 4 as printed
/// in eq. (1). A line adds one and a curve adds its degree, because elements share their ends.
constexpr int control_point_count(ElementList elements, int curve_degree = 3) noexcept {
  return 1 + static_cast<int>(elements.size()) + (curve_degree - 1) * std::popcount(elements.curves());
}

/// Number of feature points of a stroke with these elements: one more than there are elements.
constexpr int feature_point_count(ElementList elements) noexcept { return static_cast<int>(elements.size()) + 1; }

/// Indices of the feature points among the control points of a stroke (Wang 2006, sec. 3.4).
std::vector<int> feature_points(ElementList elements, int curve_degree = 3);

}  // namespace calligraphy
