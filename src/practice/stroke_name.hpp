// A stroke of a character in a sentence.
#pragma once

#include <cstddef>
#include <string>

#include <calligraphy/model/typical_stroke.hpp>

namespace calligraphy {

/// "stroke 3 (heng)", from an index that counts from 0.
inline std::string stroke_name(std::size_t index, const TypicalStroke& type) {
  return "stroke " + std::to_string(index + 1) + " (" + std::string(type.pinyin) + ")";
}

}  // namespace calligraphy
