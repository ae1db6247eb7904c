// What is to be told of writing as a whole, before anything else can be judged.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <calligraphy/judge/pen_path.hpp>
#include <calligraphy/judge/stroke_remark.hpp>

#include "character_form.hpp"

namespace calligraphy {

/// What is wrong with the writing as a whole.
struct WholeFault {
  StrokeRemarkKind kind = StrokeRemarkKind::orientation;  ///< orientation, several or parts
  WritingOrientation orientation = WritingOrientation::upright;
  std::size_t first_part = 0;  ///< number of strokes of the first part
};

/// Whether the writing is mirrored or turned, has more than one character, or has two parts in each other's place.
/// Order and direction that explain it as well are no such fault. `paths` are the pen-downs in the order of writing.
std::optional<WholeFault> whole_fault(const CharacterForm& form, std::span<const PenPath> paths);

}  // namespace calligraphy
