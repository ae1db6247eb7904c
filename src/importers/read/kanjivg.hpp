// KanjiVG: centre lines of strokes, one SVG file per character.
#pragma once

#include <string>
#include <string_view>

#include "drawing.hpp"

namespace calligraphy {

/// Parses one file: centre lines within 5e-5 em, y up, with their kvg:type as label, such as ㇕a, and the comment at its
/// head as notice. `name` is used in messages. Only the five predefined entities of XML are expanded.
/// @throws FormatError naming the place, also if it is not an SVG of 109 x 109 units with at least one stroke, or a
///         stroke consists of several lines
Drawing parse_kanjivg(std::string_view svg, const std::string& name);

}  // namespace calligraphy
