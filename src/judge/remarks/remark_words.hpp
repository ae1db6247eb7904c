// What people are told of a stroke or a pen-down, and what to do about it.
#pragma once

#include <span>
#include <string>

#include <calligraphy/judge/stroke_matching.hpp>
#include <calligraphy/model/character.hpp>

namespace calligraphy {

/// The same in two languages.
struct RemarkWords {
  std::string english;
  std::string chinese;  ///< simplified
};

/// One or two short sentences on the writing of a character with this code and these strokes. `drawn` has the pen-downs
/// of the remark.
RemarkWords words_of(const StrokeRemark& remark, std::span<const DrawnStroke> drawn, char32_t character,
                     std::span<const Stroke> strokes);

}  // namespace calligraphy
