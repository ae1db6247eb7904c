// animCJK: outlines and medians of brush strokes, one SVG file per character.
#pragma once

#include <string>
#include <string_view>

#include "drawing.hpp"

namespace calligraphy {

/// True for an SVG whose paths have the ids of animCJK: z, the code in decimal, d and the number of the stroke.
bool is_anim_cjk(std::string_view svg);

/// Parses one file: medians, outlines within 5e-4 em and the comment at its head as notice. A stroke that crosses
/// itself has several outlines, a, b and so on, which belong together. The file has 1024 units per em, y down; the
/// result is in the unit square of hanzi-writer-data, y up. `name` is used in messages.
/// @throws FormatError naming the place
Drawing parse_anim_cjk(std::string_view svg, const std::string& name);

}  // namespace calligraphy
