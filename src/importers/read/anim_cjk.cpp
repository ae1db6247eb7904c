#include "anim_cjk.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <calligraphy/base/error.hpp>

#include "base/charconv.hpp"
#include "outline_area.hpp"
#include "path_data.hpp"
#include "svg_drawing.hpp"

namespace calligraphy {
namespace {

constexpr double anim_units_per_em = 1024.0;
constexpr double anim_outline_tolerance = 5e-4;  // [em]
constexpr int max_anim_strokes = 256;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The number of the stroke, in z19968d1, or z19968d1a of several parts, or with c in place of d; 0: another id.
int stroke_number(std::string_view id, char kind) {
  if (!id.starts_with('z')) return 0;
  std::size_t at = 1;
  while (at < id.size() && is_digit(id[at])) ++at;
  if (at == 1 || at >= id.size() || id[at] != kind) return 0;
  int number = 0;
  const auto [end, error] = from_chars(id.data() + at + 1, id.data() + id.size(), number);
  const std::size_t left = static_cast<std::size_t>(id.data() + id.size() - end);
  const bool is_part = left == 1 && *end >= 'a' && *end <= 'z';
  return error == std::errc() && (left == 0 || is_part) && number > 0 ? number : 0;
}

/// The number in url(#z19968c1).
int clipped_stroke(std::string_view clip) {
  constexpr std::string_view before = "url(#";
  const bool is_url = clip.starts_with(before) && clip.ends_with(')');
  return is_url ? stroke_number(clip.substr(before.size(), clip.size() - before.size() - 1), 'c') : 0;
}

Point in_anim_em(const Point& units) { return Point(units.x(), anim_units_per_em - units.y()) / anim_units_per_em; }

/// All run counter-clockwise as a whole, as the parts of a stroke are filled one by one.
std::vector<std::vector<Point>> anim_outline(const SvgPath& path) {
  std::vector<std::vector<Point>> polygons = flattened_outline(path.data, anim_outline_tolerance * anim_units_per_em);
  double area = 0.0;
  for (std::vector<Point>& polygon : polygons) {
    for (Point& point : polygon) point = in_anim_em(point);
    area += signed_area(polygon);
  }
  for (std::vector<Point>& polygon : polygons) {
    if (area < 0.0) std::reverse(polygon.begin(), polygon.end());
  }
  return polygons;
}

/// Returns the number of its points.
std::size_t add_path(const SvgPath& path, std::map<int, SourceStroke>& strokes) {
  std::size_t points = 0;
  if (const int clipped = clipped_stroke(path.clip); clipped > 0) {
    std::vector<Point>& median = strokes[clipped].path;
    if (!median.empty()) return 0;  // that of a later part begins beside the character
    median = flattened_path(path.data, anim_outline_tolerance * anim_units_per_em);
    for (Point& point : median) point = in_anim_em(point);
    points = median.size();
  } else if (const int drawn = stroke_number(path.id, 'd'); drawn > 0) {
    for (std::vector<Point>& polygon : anim_outline(path)) {
      points += polygon.size();
      strokes[drawn].outline.push_back(std::move(polygon));
    }
  }
  return points;
}

}  // namespace

bool is_anim_cjk(std::string_view svg) {
  for (const std::string_view quoted : {"id=\"z", "id='z"}) {
    for (std::size_t at = svg.find(quoted); at != svg.npos; at = svg.find(quoted, at + 1)) {
      const std::string_view id = svg.substr(at + quoted.size() - 1);
      if (stroke_number(id.substr(0, id.find(quoted[quoted.size() - 2])), 'd') > 0) return true;
    }
  }
  return false;
}

Drawing parse_anim_cjk(std::string_view svg, const std::string& name) {
  SvgDrawing paths = parse_svg(svg, anim_units_per_em, name);
  if (paths.paths.size() > max_svg_paths) throw FormatError(name + ": more than 1024 paths");
  std::map<int, SourceStroke> strokes;
  std::size_t points = 0;
  for (const SvgPath& path : paths.paths) {
    try {
      points += add_path(path, strokes);
    } catch (const FormatError& error) {
      const std::string place = path.id.empty() ? "median" : "outline";
      const int number = path.id.empty() ? clipped_stroke(path.clip) : stroke_number(path.id, 'd');
      throw FormatError(name + ": stroke " + std::to_string(number) + ": " + place + ": path data " + error.what());
    }
    if (points > max_drawing_points) throw FormatError(name + ": " + too_many_points());
  }
  if (strokes.empty()) throw FormatError(name + ": no <path> of a stroke");
  Drawing drawing;
  drawing.notice = std::move(paths.notice);
  for (auto& [number, stroke] : strokes) {
    const std::string place = name + ": stroke " + std::to_string(number);
    if (number != static_cast<int>(drawing.strokes.size()) + 1 || number > max_anim_strokes) {
      throw FormatError(place + ": expected strokes from 1 to at most 256, without gaps");
    }
    if (stroke.path.empty()) throw FormatError(place + ": has no median, a path whose clip-path is its outline");
    if (area_of(stroke.outline) < least_outline_area) throw FormatError(place + ": has no outline, or one without area");
    drawing.strokes.push_back(std::move(stroke));
  }
  return drawing;
}

}  // namespace calligraphy
