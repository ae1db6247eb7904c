// What people are told of a stroke or a pen-down.
#pragma once

#include <span>
#include <string>

#include <calligraphy/model/character.hpp>
#include <calligraphy/practice/stroke_matching.hpp>

namespace calligraphy {

/// One sentence on the writing of a character with this code and these strokes. `drawn` has the pen-downs of the
/// remark.
std::string sentence(const StrokeRemark& remark, std::span<const DrawnStroke> drawn, char32_t character,
                     std::span<const Stroke> strokes);

}  // namespace calligraphy
