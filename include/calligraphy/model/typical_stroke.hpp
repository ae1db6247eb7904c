// The 39 typical strokes that make up every character (Wang 2006, sec. 3.1, Fig. 7).
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include <calligraphy/model/element_list.hpp>
#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// Number of entries of the stroke library; their ids run from 1 to this.
inline constexpr int typical_stroke_count = 39;

/// One entry of the stroke library. The id is independent of the size and position of a stroke.
///
/// Ids 1, 2, 4, 10, 16, 20 and 31 are the paper's, inferred from Table 3 and Figs. 11 and 12. Fig. 7 is lost, so the
/// other ids are this library's.
struct TypicalStroke {
  int id;                     ///< number in the stroke library, 1 to 39
  std::string_view name;      ///< Chinese name
  std::string_view pinyin;    ///< romanised name
  std::string_view code;      ///< letter code as used for CJK strokes
  std::string_view unicode;   ///< code point of the CJK stroke in hexadecimal, with "var" if it is a variant
  std::string_view elements;  ///< its composition: 'L' (LSE) or 'C' (CSE) per element, in writing order
  std::string_view joints;    ///< one per inner feature point: 'c' corner, 's' smooth (tangent continuous)
  std::string_view example;   ///< characters that contain it
  std::span<const std::array<double, 2>> shape;  ///< typical control points, cubic curves [em]

  /// Its composition as the paper counts it, with a line for a round bend (Table 3, Figs. 11 and 12), if that differs.
  /// Files of format 1 use it.
  std::string_view printed_elements = {};

  /// `printed_elements`, or `elements` if the paper's composition does not differ.
  constexpr std::string_view as_printed() const noexcept {
    return printed_elements.empty() ? elements : printed_elements;
  }
};

/// All typical strokes, by id.
std::span<const TypicalStroke> typical_strokes() noexcept;

/// The typical stroke with this id. @throws ValueError if id is not in 1..39
const TypicalStroke& typical_stroke(int id);

/// Whether a stroke of this type but with these elements is smooth after element `index`: wherever the typical stroke
/// is, except at a joint between two lines.
constexpr bool is_smooth_joint(const TypicalStroke& type, std::string_view elements, std::size_t index) {
  constexpr char curve = static_cast<char>(ElementKind::curve);
  return type.joints[index] == 's' && (elements[index] == curve || elements[index + 1] == curve);
}

}  // namespace calligraphy
