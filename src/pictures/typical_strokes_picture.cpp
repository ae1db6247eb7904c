// The poster of the typical strokes.
#include <calligraphy/pictures/picture.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <calligraphy/model/bezier.hpp>
#include <calligraphy/model/typical_ink.hpp>
#include <calligraphy/model/typical_stroke.hpp>
#include <calligraphy/pictures/chinese_font.hpp>

#include "svg.hpp"

namespace calligraphy {
namespace {

using svg::add;
using svg::add_text;

// A3, whose proportions all A sizes have [mm].
constexpr double poster_width = 420.0, poster_height = 297.0;
constexpr int poster_columns = 8;
constexpr double cell_em = 35.0, column_step = 49.0, row_step = 53.8, first_column = 24.0, first_row = 23.0;
constexpr double line_stroke_width = 2.5, head_length = 2.1, small_text = 3.6;

// On a shorter element an arrow head would hide the ink of a hook, or crowd the control points of a bend [em].
constexpr double shortest_line_with_head = 0.16, shortest_curve_with_head = 0.22;

constexpr const char* poster_ink = "#1d1d1f";
constexpr const char* grid_red = "#ecd3cc";
constexpr const char* path_red = "#f0502d";  // seen on ink and on paper
constexpr const char* control_blue = "#6d9bd8";
constexpr const char* quiet_grey = "#6b6b6b";

constexpr const char* poster_title = "基本笔画";

// The lines of the key, in English and, where a font has them, the Chinese terms. A line without explains that above.
constexpr std::pair<const char*, const char*> key_lines[] = {
    {"start", "起笔"}, {"direction", "行笔方向"}, {"end", "收笔"},
    {"feature point", "特征点"}, {"where pieces meet", ""},
    {"control point", "控制点"}, {"it bends a curve", ""},
    {"line", "直线"}, {"curve", "曲线"}};

// What the letters below the names mean.
constexpr std::pair<const char*, const char*> letter_lines[] = {
    {"HZWG", "the letter code of the CJK stroke: the initials of its Chinese name, héng zhé wān gōu"},
    {"BXG", "the initials of another name, biǎn xié gōu; with a slash, as in SZWG/SZZG, those of two names"},
    {"LLCLL", "its pieces in the order of writing, lines (L) and curves (C)"}};

constexpr const char* latin_fonts = "'Noto Sans', 'Source Sans 3', 'Helvetica Neue', Arial, sans-serif";
constexpr const char* chinese_fonts = "'Noto Sans CJK SC', 'Source Han Sans SC', 'Noto Sans SC', 'PingFang SC', "
                                      "'Microsoft YaHei', 'WenQuanYi Micro Hei', sans-serif";

/// The font, then those of other computers, as CSS.
std::string families(const std::string& font) {
  std::string family;
  for (const char letter : svg::clean(font)) {
    if (letter == '\'' || letter == '\\') family += '\\';
    family += letter;
  }
  return "'" + family + "', " + chinese_fonts;
}

void draw_feature_point(pugi::xml_node parent, const Point& at) {
  svg::add_circle(parent, "feature", at, "0.42", {{"fill", "#ffffff"}, {"stroke", path_red}, {"stroke-width", "0.2"}});
}

/// Small, so that the point of a hook is seen.
void draw_end(pugi::xml_node parent, const Point& at) {
  svg::add_circle(parent, "end", at, "0.34", {{"fill", path_red}});
}

void draw_control_point(pugi::xml_node parent, const Point& at) {
  svg::add_circle(parent, "control", at, "0.55",
                  {{"fill", control_blue}, {"stroke", "#ffffff"}, {"stroke-width", "0.25"}});
}

void draw_start(pugi::xml_node parent, const Point& at) {
  svg::add_circle(parent, "start", at, "0.7", {{"fill", path_red}});
}

void draw_polygon(pugi::xml_node parent, std::span<const Point> points) {
  add(parent, "path", {{"class", "polygon"}, {"d", svg::line_path(points)}, {"fill", "none"}, {"stroke", control_blue},
                       {"stroke-width", "0.22"}, {"stroke-dasharray", "0.9 0.6"}});
}

/// An arrow head about a point of the path.
void draw_direction(pugi::xml_node parent, const Point& at, const Point& direction) {
  const Point ahead = head_length * direction.normalized();
  const Point side = 0.42 * Point(-ahead.y(), ahead.x());
  const Point back = at - 0.5 * ahead;
  const std::vector<Point> head = {at + 0.5 * ahead, back + side, back + 0.25 * ahead, back - side};
  add(parent, "path", {{"class", "direction"}, {"d", svg::polygon_path(head)}, {"fill", path_red}});
}

void draw_middle_line(pugi::xml_node parent, const std::string& path) {
  add(parent, "path", {{"class", "path"}, {"d", path}, {"fill", "none"}, {"stroke", path_red}, {"stroke-width", "0.2"},
                       {"stroke-linejoin", "round"}});
}

/// A square with the lines of 米字格, by which pupils place a character.
void draw_cell_square(pugi::xml_node parent, const Point& corner) {
  const auto line = [&](double x1, double y1, double x2, double y2) {
    const std::vector<Point> ends = {corner + cell_em * Point(x1, y1), corner + cell_em * Point(x2, y2)};
    return svg::line_path(ends);
  };
  const std::string lines = line(0, 0, 1, 1) + line(1, 0, 0, 1) + line(0.5, 0, 0.5, 1) + line(0, 0.5, 1, 0.5);
  add(parent, "path", {{"class", "grid"}, {"d", lines}, {"fill", "none"}, {"stroke", grid_red},
                       {"stroke-width", "0.15"}, {"stroke-dasharray", "1 0.8"}});
  svg::add_rect(parent, corner, cell_em, cell_em,
                {{"class", "frame"}, {"fill", "none"}, {"stroke", grid_red}, {"stroke-width", "0.3"}});
}

void draw_marks(pugi::xml_node parent, const Stroke& stroke, const svg::View& view) {
  const std::vector<Point> points = view(stroke.control_points);
  const std::vector<int> features = feature_points(stroke.elements);
  const auto is_curve = [&](std::size_t element) {
    return stroke.elements[element] == static_cast<char>(ElementKind::curve);
  };
  for (std::size_t i = 0; i < stroke.elements.size(); ++i) {
    if (is_curve(i)) draw_polygon(parent, std::span(points).subspan(static_cast<std::size_t>(features[i]), 4));
  }
  draw_middle_line(parent, svg::stroke_path(stroke, view));
  for (std::size_t i = 0; i < stroke.elements.size(); ++i) {
    const auto first = static_cast<std::size_t>(features[i]), last = static_cast<std::size_t>(features[i + 1]);
    const double shortest = is_curve(i) ? shortest_curve_with_head : shortest_line_with_head;
    const bool has_head = (points[last] - points[first]).norm() >= shortest * cell_em;
    if (is_curve(i)) {
      const Bezier<3> curve{{points[first], points[first + 1], points[first + 2], points[last]}};
      if (has_head) draw_direction(parent, curve.point(0.5), curve.derivative(0.5));
      draw_control_point(parent, points[first + 1]);
      draw_control_point(parent, points[first + 2]);
    } else if (has_head) {
      draw_direction(parent, 0.5 * (points[first] + points[last]), points[last] - points[first]);
    }
  }
  draw_start(parent, points[0]);
  for (std::size_t i = 1; i < stroke.elements.size(); ++i) {
    draw_feature_point(parent, points[static_cast<std::size_t>(features[i])]);
  }
  draw_end(parent, points.back());
}

void write_names(pugi::xml_node parent, const TypicalStroke& type, const std::string& font, const Point& corner) {
  const double x = corner.x(), below = corner.y() + cell_em;
  add_text(parent, x - 1.8, corner.y() + 3.3, 4.6, std::to_string(type.id),
           {{"class", "number"}, {"text-anchor", "end"}, {"font-weight", "bold"}, {"fill", quiet_grey}});
  if (!font.empty()) {
    add_text(parent, x, below + 6.0, 5.4, std::string(type.name),
             {{"class", "name"}, {"font-family", families(font)}, {"xml:lang", "zh-Hans"}});
  }
  add_text(parent, x, below + (font.empty() ? 6.0 : 11.1), 4.6, std::string(type.pinyin), {{"class", "pinyin"}});
  const std::string code = std::string(type.code) + " \u00b7 " + std::string(type.elements);
  add_text(parent, x, below + (font.empty() ? 11.0 : 15.6), small_text, code,
           {{"class", "code"}, {"fill", quiet_grey}});
}

void draw_typical_stroke(pugi::xml_node parent, const TypicalStroke& type, StrokeStyle style, const std::string& font,
                         const Point& corner) {
  draw_cell_square(parent, corner);
  std::vector<Point> em_points;
  for (const auto& point : type.shape) em_points.emplace_back(point[0], point[1]);
  const svg::View view{corner + Point(0.0, cell_em), cell_em};
  const Character character = with_typical_ink(make_character(0, std::array{StrokeInput{type.id, em_points}}));
  const Stroke stroke = strokes(character).front();
  pugi::xml_node group = svg::add_stroke_group(parent, "template", style, poster_ink, line_stroke_width);
  svg::add_stroke(group, stroke, style, view);
  draw_marks(parent, stroke, view);
  write_names(parent, type, font, corner);
}

void draw_key(pugi::xml_node parent, const std::string& font, const Point& corner) {
  const auto at = [&](int row) { return Point(corner + Point(0.0, 2.0 + 5.6 * row)); };
  const auto across = [](const Point& middle) {
    return std::array{Point(middle - Point(4.0, 0.0)), Point(middle + Point(4.0, 0.0))};
  };
  int row = 0;
  for (const auto& [english, chinese] : key_lines) {
    const Point place = at(row++) + Point(6.0, 0.35 * small_text);
    const bool explains = std::string_view(chinese).empty();
    pugi::xml_node text = add_text(parent, place.x(), place.y(), small_text, english,
                                   {{"fill", explains ? quiet_grey : poster_ink}});
    if (font.empty() || explains) continue;
    add(text, "tspan", {{"dx", "1.3"}, {"font-family", families(font)}, {"xml:lang", "zh-Hans"}}).text() = chinese;
  }
  draw_start(parent, at(0));
  draw_middle_line(parent, svg::line_path(across(at(1))));
  draw_direction(parent, at(1), Point(1.0, 0.0));
  draw_end(parent, at(2));
  draw_feature_point(parent, at(3));
  draw_polygon(parent, across(at(5)));
  draw_control_point(parent, at(5));
  for (const auto& [letter, letter_row] : {std::pair{"L", 7}, std::pair{"C", 8}}) {
    add_text(parent, at(letter_row).x(), at(letter_row).y() + 0.35 * small_text, small_text, letter,
             {{"text-anchor", "middle"}, {"font-weight", "bold"}});
  }
}

void explain_letters(pugi::xml_node parent, const Point& corner) {
  Point at = corner;
  for (const auto& [letters, text] : letter_lines) {
    add_text(parent, at.x(), at.y(), small_text, letters, {{"font-weight", "bold"}});
    add_text(parent, at.x() + 16.0, at.y(), small_text, text);
    at.y() += 4.8;
  }
}

}  // namespace

std::string typical_strokes_font() {
  std::string text = poster_title;
  for (const auto& line : key_lines) text += line.second;
  for (const TypicalStroke& type : typical_strokes()) text += type.name;
  return chinese_font(text);
}

std::string typical_strokes_picture(StrokeStyle style, const std::string& font) {
  const std::string title = "The " + std::to_string(typical_stroke_count) + " typical strokes";
  pugi::xml_document document;
  pugi::xml_node root = svg::begin(document, poster_width, poster_height, "mm", title);
  root.attribute("font-family") = latin_fonts;
  root.append_attribute("fill") = poster_ink;
  double title_x = first_column;
  if (!font.empty()) {
    add_text(root, title_x, 15.5, 8.0, poster_title, {{"font-family", families(font)}, {"xml:lang", "zh-Hans"}});
    title_x += svg::text_width(poster_title, 8.0) + 4.0;
  }
  add_text(root, title_x, 15.5, 5.5, title, {{"fill", font.empty() ? poster_ink : quiet_grey}});

  const auto corner = [](int index) {
    return Point(first_column + column_step * (index % poster_columns),
                 first_row + row_step * (index / poster_columns));
  };
  for (const TypicalStroke& type : typical_strokes()) {
    draw_typical_stroke(add(root, "g", {{"class", "stroke"}}), type, style, font, corner(type.id - 1));
  }
  pugi::xml_node key = add(root, "g", {{"class", "key"}});
  explain_letters(key, Point(corner(3).x(), 8.5));
  draw_key(key, font, corner(typical_stroke_count) - Point(5.0, 0.0));
  return svg::to_string(document);
}

}  // namespace calligraphy
