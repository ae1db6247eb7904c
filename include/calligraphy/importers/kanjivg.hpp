// KanjiVG: the centre lines of strokes, an SVG file per character.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

struct KanjivgStroke {
  std::string label;        ///< kvg:type, such as ㇕a; empty where there is none
  std::vector<Point> path;  ///< [em], y up; within 5e-5 em of the centre line
};

struct KanjivgDrawing {
  std::vector<KanjivgStroke> strokes;  ///< in writing order
  std::string notice;                  ///< the copyright notice at the head of the file
};

/// Reads one file. `name` is used in messages. Entities beyond XML's own five are not expanded.
/// @throws FormatError naming the place, for what is no SVG of 109 units a side with at least one stroke, too, and for
///         path commands other than M, C and S
KanjivgDrawing parse_kanjivg(std::string_view svg, const std::string& name);

}  // namespace calligraphy
