// The 39 typical strokes from which every character is made (Wang 2006, sec. 3.1, Fig. 7).
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

inline constexpr int typical_stroke_count = 39;

/// Maxima over all typical strokes, quartic curves included, so that a stroke fits in fixed storage.
inline constexpr int max_elements_per_stroke = 5;
inline constexpr int max_curve_degree = 4;
inline constexpr int max_control_points_per_stroke = 17;

/// Kind of a stroke element (Wang 2006, sec. 3.2): line segment (LSE) or Bezier curve segment (CSE).
enum class ElementKind : char { line = 'L', curve = 'C' };

/// One entry of the stroke library. The id is independent of the size and position of a stroke.
///
/// Ids 1, 2, 4, 10, 16, 20 and 31 are the paper's, inferred from Table 3 and Figs. 11 and 12. Fig. 7 is lost, so the
/// other ids are this library's.
struct TypicalStroke {
  int id;                     ///< 1 to 39
  std::string_view name;      ///< Chinese name
  std::string_view pinyin;    ///< romanised name
  std::string_view code;      ///< letter code as used for CJK strokes
  std::string_view unicode;   ///< code point of the CJK stroke in hexadecimal, with "var" if it is a variant
  std::string_view elements;  ///< 'L' (LSE) or 'C' (CSE) per element, in writing order
  std::string_view joints;    ///< one per inner feature point: 'c' corner, 's' smooth (tangent continuous)
  std::string_view example;   ///< characters that contain it
  std::span<const std::array<double, 2>> shape;  ///< typical control points, cubic curves [em]

  /// Number of control points for curves of the given degree (3 by default, 4 as printed in eq. (1)).
  int control_point_count(int curve_degree = 3) const;
  /// Number of feature points: one more than elements.
  int feature_point_count() const { return static_cast<int>(elements.size()) + 1; }
  /// Indices of the feature points among the control points of the stroke (Wang 2006, sec. 3.4).
  std::vector<int> feature_points(int curve_degree = 3) const;
};

/// All typical strokes, by id.
std::span<const TypicalStroke> typical_strokes() noexcept;

/// The typical stroke with this id. @throws ValueError if id is not in 1..39
const TypicalStroke& typical_stroke(int id);

}  // namespace calligraphy
