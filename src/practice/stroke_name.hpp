// A stroke of a character in a sentence.
#pragma once

#include <cstddef>
#include <string>

#include <calligraphy/model/typical_stroke.hpp>
#include <calligraphy/practice/stroke_matching.hpp>

namespace calligraphy {

/// "stroke 3 (heng)", from an index that counts from 0.
inline std::string stroke_name(std::size_t index, const TypicalStroke& type) {
  return "stroke " + std::to_string(index + 1) + " (" + std::string(type.pinyin) + ")";
}

inline StrokeRemark missing_remark(int index, const TypicalStroke& type) {
  return {StrokeRemarkKind::missing, -1, index,
          stroke_name(static_cast<std::size_t>(index), type) + " was not written"};
}

}  // namespace calligraphy
