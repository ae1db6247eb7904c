// KanjiVG: centre lines of strokes, one SVG file per character.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

struct KanjivgStroke {
  std::string label;        ///< kvg:type, such as ㇕a; empty if there is none
  std::vector<Point> path;  ///< [em], y up; within 5e-5 em of the centre line
};

struct KanjivgDrawing {
  std::vector<KanjivgStroke> strokes;  ///< in writing order
  std::string notice;                  ///< the copyright notice at the head of the file
};

/// Parses one file. `name` is used in messages. Only the five predefined entities of XML are expanded.
/// @throws FormatError naming the place, also if it is not an SVG of 109 x 109 units with at least one stroke, and for
///         path commands other than M, C and S
KanjivgDrawing parse_kanjivg(std::string_view svg, const std::string& name);

}  // namespace calligraphy
