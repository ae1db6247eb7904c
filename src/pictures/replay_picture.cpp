#include <calligraphy/pictures/replay_picture.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/typical_ink.hpp>

#include "judge/pens/resemblance.hpp"
#include "marks.hpp"
#include "svg.hpp"

namespace calligraphy {
namespace {

using svg::add;
using svg::add_text;
using svg::faint;
using svg::ink;

constexpr const char* device_colour = "#2f9e44";

// [mm]
constexpr double sheet_margin = 6.0;
constexpr double square_side = 86.0;           ///< of a square
constexpr double sheet_top = 19.0;             ///< title and headings
constexpr double border = 0.09 * square_side;  ///< within the square, around the drawing: space for numbers
constexpr double text_size = 3.4;
constexpr double line_height = 4.6;
constexpr marks::Sizes sizes;

/// Round all that is shown [em].
Eigen::AlignedBox2d box_of(const Character& character, std::span<const PenPath> laid, const MatchResult& match,
                           std::span<const PenPath> guided) {
  Eigen::AlignedBox2d box = bounding_box({character, {Point::Zero(), 1.0}});
  for (std::size_t i = 0; i < laid.size(); ++i) {
    if (marks::bounced(match.drawn[i])) continue;
    for (const Point& point : laid[i]) box.extend(point);
  }
  for (const PenPath& path : guided) {
    for (const Point& point : path) box.extend(point);
  }
  return box;
}

/// Shows a box of the em [em] as large as it can be in the square at `x`.
svg::View view_of(const Eigen::AlignedBox2d& box, double x) {
  const double scale = (square_side - 2.0 * border) / std::max(box.sizes().maxCoeff(), 0.1);
  const Point middle(x + 0.5 * square_side, sheet_top + 0.5 * square_side);
  return {middle - scale * Point(box.center().x(), -box.center().y()), scale};
}

/// The square at `x`, its heading and the template.
void draw_square(pugi::xml_node root, const Character& character, StrokeStyle style, double x,
                 const std::string& heading, const svg::View& view) {
  add_text(root, x + 0.5 * square_side, sheet_top - 2.5, text_size, heading,
           {{"text-anchor", "middle"}, {"fill", ink}});
  svg::add_rect(root, {x, sheet_top}, square_side, square_side,
                {{"fill", "none"}, {"stroke", faint}, {"stroke-width", "0.3"}});
  pugi::xml_node group = svg::add_stroke_group(root, "template", style, marks::template_colour, 0.035 * square_side);
  for (const Stroke& stroke : strokes(character)) svg::add_stroke(group, stroke, style, view);
}

void draw_written(pugi::xml_node root, const Character& character, std::span<const PenPath> paths,
                  const MatchResult& match, const svg::View& view) {
  pugi::xml_node lines = marks::add_lines(root, "written", sizes.line);
  marks::Numbers numbers(root, sizes.label);
  pugi::xml_node drawn = numbers.add_group(root, "drawn-number", "normal");
  pugi::xml_node standard = numbers.add_group(root, "standard-number", "italic");
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (!marks::bounced(match.drawn[i])) numbers.labels().avoid(view(paths[i]));
  }
  std::vector<Point> places = marks::places_of_form(match);
  for (Point& place : places) place = match.fit(place);
  marks::draw_rings(lines, view(places), sizes, numbers.labels());
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (marks::bounced(match.drawn[i])) continue;
    const std::vector<Point> points = view(paths[i]);
    const char* const colour = marks::colour_of(match, i);
    marks::draw_path(lines, points, colour);
    marks::draw_arrow(lines, points, colour, sizes.arrow);
    numbers.draw(drawn, points, i + 1, colour);
  }
  const std::vector<std::vector<Point>> templates = middle_lines(character);
  for (std::size_t i = 0; i < templates.size(); ++i) {
    numbers.draw(standard, view(templates[i]), i + 1,
                 marks::is_missing(match, i) ? marks::wrong : marks::number_colour);
  }
}

void draw_guided(pugi::xml_node root, std::span<const PenPath> guided, const svg::View& view) {
  pugi::xml_node lines = marks::add_lines(root, "guided", sizes.line);
  for (const PenPath& path : guided) marks::draw_path(lines, view(path), device_colour);
}

std::vector<std::string> lines_of(const MatchResult& match, const Character& character, const Language& language) {
  std::vector<std::string> lines = marks::remark_lines(match, character, language);
  if (lines.empty()) lines.push_back(language.text("picture.no_remark"));
  return lines;
}

}  // namespace

std::string replay_picture(const Character& character, std::span<const PenPath> paths, const MatchResult& match,
                           std::span<const PenPath> guided, const std::string& title, StrokeStyle style,
                           const Language& language) {
  if (match.drawn.size() != paths.size()) {
    throw ValueError("replay picture: the match has " + std::to_string(match.drawn.size()) +
                     " pen-downs, expected the same number as paths, " + std::to_string(paths.size()));
  }
  const std::vector<std::string> lines = lines_of(match, character, language);
  const double width = 3.0 * sheet_margin + 2.0 * square_side;
  const double height = sheet_top + square_side + 4.0 + line_height * static_cast<double>(lines.size() + 1) + 3.0;
  pugi::xml_document document;
  const std::string heading = svg::clean(title);
  pugi::xml_node root = svg::begin(document, width, height, "mm", heading);
  add_text(root, 0.5 * width, 8.5, 5.0, heading, {{"text-anchor", "middle"}, {"fill", ink}});
  std::vector<PenPath> laid;
  for (const PenPath& path : paths) {
    PenPath& moved = laid.emplace_back();
    for (const Point& point : path) moved.push_back(match.fit(point));
  }
  const Eigen::AlignedBox2d box = box_of(character, laid, match, guided);
  const svg::View left = view_of(box, sheet_margin), right = view_of(box, 2.0 * sheet_margin + square_side);
  const Character inked = with_typical_ink(character);
  draw_square(root, inked, style, sheet_margin, language.text("picture.as_written"), left);
  draw_written(root, character, laid, match, left);
  draw_square(root, inked, style, 2.0 * sheet_margin + square_side, language.text("picture.guided"), right);
  draw_guided(root, guided, right);

  double y = sheet_top + square_side + 5.5;
  add_text(root, sheet_margin, y, 0.9 * text_size, language.text("picture.colours"), {{"fill", "#777777"}});
  for (const std::string& line : lines) {
    y += line_height;
    const double size = text_size * std::min(1.0, 2.0 * square_side / svg::text_width(line, text_size));
    add_text(root, sheet_margin, y, size, line, {{"fill", ink}});
  }
  return svg::to_string(document);
}

}  // namespace calligraphy
