// The contact sheet of the typical strokes.
#include <calligraphy/pictures/picture.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <calligraphy/model/typical_ink.hpp>
#include <calligraphy/model/typical_stroke.hpp>

#include "svg.hpp"

namespace calligraphy {
namespace {

using svg::add;
using svg::add_text;
using svg::faint;
using svg::ink;

// [px]
constexpr int sheet_columns = 8;
constexpr double cell_width = 150.0, cell_height = 196.0, cell_em = 128.0, table_margin = 24.0, table_top = 64.0;
constexpr const char* point_red = "#d62020";
constexpr const char* stroke_blue = "#a9c4f5";
constexpr const char* polygon_grey = "#777777";

void draw_feature_point(pugi::xml_node parent, const Point& at) {
  svg::add_circle(parent, "feature", at, "3", {{"fill", point_red}});
}

void draw_control_point(pugi::xml_node parent, const Point& at) {
  svg::add_circle(parent, "control", at, "3", {{"fill", "#ffffff"}, {"stroke", polygon_grey}});
}

/// A ring round the start and an arrow head that leaves it.
void draw_start(pugi::xml_node parent, const Point& start, const Point& towards) {
  const Point direction = (towards - start).normalized();
  const Point side(-direction.y(), direction.x());
  svg::add_circle(parent, "start", start, "6.5", {{"fill", "none"}, {"stroke", point_red}, {"stroke-width", "1.3"}});
  const Point back = start + 10.0 * direction;
  const std::vector<Point> head = {start + 19.0 * direction, back + 4.2 * side, back - 4.2 * side};
  add(parent, "path", {{"d", svg::polygon_path(head)}, {"fill", point_red}});
}

void draw_polygon(pugi::xml_node parent, std::span<const Point> points) {
  const std::string line = svg::line_path(points);
  add(parent, "path", {{"d", line}, {"fill", "none"}, {"stroke", polygon_grey}, {"stroke-dasharray", "4 3"}});
}

void draw_frame(pugi::xml_node parent, double x, double y) {
  svg::add_rect(parent, {x, y}, cell_em, cell_em, {{"fill", "none"}, {"stroke", faint}});
}

void draw_typical_stroke(pugi::xml_node parent, const TypicalStroke& type, StrokeStyle style, double x, double y) {
  draw_frame(parent, x, y);
  std::vector<Point> em_points;
  for (const auto& point : type.shape) em_points.emplace_back(point[0], point[1]);
  const svg::View view{{x, y + cell_em}, cell_em};
  const Character character = with_typical_ink(make_character(0, std::array{StrokeInput{type.id, em_points}}));
  pugi::xml_node group = svg::add_stroke_group(parent, "template", style, stroke_blue, 9.0);
  svg::add_stroke(group, strokes(character).front(), style, view);

  const std::vector<Point> points = view(em_points);
  const std::vector<int> features = feature_points(type.elements);
  for (std::size_t i = 0; i < type.elements.size(); ++i) {
    if (type.elements[i] != static_cast<char>(ElementKind::curve)) continue;
    const auto first = static_cast<std::size_t>(features[i]);
    draw_polygon(parent, std::span(points).subspan(first, 4));
    draw_control_point(parent, points[first + 1]);
    draw_control_point(parent, points[first + 2]);
  }
  draw_start(parent, points[0], points[1]);
  for (const int feature : features) draw_feature_point(parent, points[static_cast<std::size_t>(feature)]);

  const double middle = x + 0.5 * cell_em;
  const double below = y + cell_em;
  add_text(parent, middle, below + 18.0, 15.0, std::to_string(type.id) + "  " + std::string(type.name),
           {{"font-weight", "bold"}, {"xml:lang", "zh-Hans"}});
  add_text(parent, middle, below + 34.0, 12.5, std::string(type.pinyin));
  add_text(parent, middle, below + 49.0, 11.5, std::string(type.code) + "  \u00b7  " + std::string(type.elements),
           {{"fill", "#666666"}});
}

void draw_key(pugi::xml_node parent, double x, double y) {
  draw_frame(parent, x, y);
  const double text_x = x + 34.0;
  const auto line = [&](double offset, const char* text) {
    add_text(parent, text_x, y + offset + 4.0, 11.0, text, {{"text-anchor", "start"}});
    return Point(x + 16.0, y + offset);
  };
  const Point start = line(18.0, "start, direction");
  draw_start(parent, start - Point(4.0, 0.0), start + Point(20.0, 0.0));
  draw_feature_point(parent, start - Point(4.0, 0.0));
  draw_feature_point(parent, line(42.0, "feature point"));
  draw_control_point(parent, line(66.0, "control point"));
  const Point polygon = line(90.0, "control polygon");
  draw_polygon(parent, std::array{Point(polygon - Point(10.0, 0.0)), Point(polygon + Point(10.0, 0.0))});
  add_text(parent, x + 6.0, y + 116.0, 11.0, "L line, C B\u00e9zier curve", {{"text-anchor", "start"}});
}

}  // namespace

std::string typical_strokes_picture(StrokeStyle style) {
  constexpr int rows = (typical_stroke_count + sheet_columns) / sheet_columns;  // one more cell, for the key
  const double width = sheet_columns * cell_width + 2.0 * table_margin;
  const std::string title = "The " + std::to_string(typical_stroke_count) + " typical strokes";
  pugi::xml_document document;
  pugi::xml_node root = svg::begin(document, width, table_top + rows * cell_height, "px", title);
  add_text(root, 0.5 * width, 38.0, 22.0, title, {{"text-anchor", "middle"}, {"fill", ink}});

  const auto cell = [](int index) {
    return Point(table_margin + (index % sheet_columns) * cell_width + 0.5 * (cell_width - cell_em),
                 table_top + (index / sheet_columns) * cell_height);
  };
  for (const TypicalStroke& type : typical_strokes()) {
    pugi::xml_node group = add(root, "g", {{"class", "stroke"}, {"text-anchor", "middle"}, {"fill", ink}});
    const Point corner = cell(type.id - 1);
    draw_typical_stroke(group, type, style, corner.x(), corner.y());
  }
  const Point corner = cell(typical_stroke_count);
  draw_key(add(root, "g", {{"class", "key"}, {"fill", ink}}), corner.x(), corner.y());
  return svg::to_string(document);
}

}  // namespace calligraphy
