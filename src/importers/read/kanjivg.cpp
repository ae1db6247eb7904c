#include "kanjivg.hpp"

#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/text.hpp>

#include "path_data.hpp"
#include "svg_drawing.hpp"

namespace calligraphy {
namespace {

constexpr std::size_t max_svg_strokes = 256;
constexpr std::size_t max_label = 64;  // [byte]
constexpr double svg_units_per_em = 109.0;
constexpr double svg_tolerance = 5e-5;  // [em]

SourceStroke stroke_of(SvgPath path, const std::string& place) {
  if (path.label.size() > max_label) throw FormatError(place + ": kvg:type is longer than 64 bytes");
  try {
    decode_utf8(path.label);
  } catch (const FormatError& error) {
    throw FormatError(place + ": kvg:type: " + error.what());
  }
  SourceStroke stroke;
  try {
    stroke.path = flattened_path(path.data, svg_tolerance * svg_units_per_em);
  } catch (const FormatError& error) {
    throw FormatError(place + ": path data " + error.what());
  }
  stroke.label = std::move(path.label);
  for (Point& point : stroke.path) point = Point(point.x(), svg_units_per_em - point.y()) / svg_units_per_em;
  return stroke;
}

}  // namespace

Drawing parse_kanjivg(std::string_view svg, const std::string& name) {
  SvgDrawing lines = parse_svg(svg, svg_units_per_em, name);
  if (lines.paths.empty()) throw FormatError(name + ": no <path> element: there is no stroke");
  if (lines.paths.size() > max_svg_strokes) throw FormatError(name + ": more than 256 strokes");
  Drawing drawing;
  std::size_t points = 0;
  drawing.notice = std::move(lines.notice);
  for (SvgPath& path : lines.paths) {
    const std::string place = name + ": stroke " + std::to_string(drawing.strokes.size() + 1);
    drawing.strokes.push_back(stroke_of(std::move(path), place));
    if ((points += drawing.strokes.back().point_count()) > max_drawing_points) {
      throw FormatError(place + ": " + too_many_points());
    }
  }
  return drawing;
}

}  // namespace calligraphy
