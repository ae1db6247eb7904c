// The picture of a force field.
#include <calligraphy/experiments/force_field.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>

#include <calligraphy/base/error.hpp>

#include "pictures/svg.hpp"

namespace calligraphy {
namespace {

using svg::add;
using svg::add_text;
using svg::number;

// [px]
constexpr double map_square = 318.0, map_margin = 16.0, map_gap = 14.0, map_top = 66.0, note_height = 22.0,
                 key_height = 46.0;
constexpr double max_arrow = 15.0, arrow_spacing = 16.6;
constexpr double millimetres = 1e3;
constexpr double fullest = 5.0;  ///< force that has the last colour and the longest arrow [N]

constexpr const char* field_ink = "#222222";
constexpr const char* field_faint = "#cccccc";
constexpr const char* active_blue = "#1f5fd0";
constexpr const char* other_grey = "#8a8a8a";
constexpr const char* jump_red = "#e00000";
constexpr const char* passage_orange = "#d97800";
constexpr const char* pen_yellow = "#ffd000";

/// Colours from no force to `fullest`, light enough for dark arrows.
constexpr std::array colours = {"#ffffff", "#f4f8ec", "#e6f2d9", "#d6ebc9", "#c2e2be",
                                "#abd8b9", "#95cdb9", "#82c2bc", "#74b5be", "#6aa7bd"};

double rounded(double pixels) { return std::round(10.0 * pixels) / 10.0; }

/// Rounds to a tenth of a pixel, which halves the text.
Point rounded(const Point& point) { return {rounded(point.x()), rounded(point.y())}; }

/// "x,y", for a path.
std::string pair(const Point& point) { return number(rounded(point.x())) + "," + number(rounded(point.y())); }

std::size_t level(double force) {
  const double scaled = force / fullest * static_cast<double>(colours.size());
  return std::min(static_cast<std::size_t>(scaled), colours.size() - 1);
}

/// Runs of equal colour as one path per colour; the first is the paper's white.
void draw_sizes(pugi::xml_node parent, const ForceField& field, const Point& corner) {
  const double cell = map_square / field.columns;
  std::array<std::string, colours.size()> paths;
  for (int row = 0; row < field.columns; ++row) {
    const double y = corner.y() + map_square - (row + 0.5) * cell;
    for (int begin = 0; begin < field.columns;) {
      const std::size_t own = level(field.force(begin, row).norm());
      int end = begin + 1;
      while (end < field.columns && level(field.force(end, row).norm()) == own) ++end;
      const double left = rounded(corner.x() + begin * cell), right = rounded(corner.x() + end * cell);
      if (own > 0) paths[own] += "M" + pair({left, y}) + "h" + number(rounded(right - left));
      begin = end;
    }
  }
  for (std::size_t i = 1; i < colours.size(); ++i) {
    if (paths[i].empty()) continue;
    // A little wider than a row, or light would show between them.
    add(parent, "path",
        {{"d", paths[i]}, {"stroke", colours[i]}, {"stroke-width", number(rounded(cell + 0.3))}, {"fill", "none"}});
  }
}

/// Shaft and head of an arrow round `middle`, the head's two barbs drawn from its tip.
std::string arrow(const Point& middle, const Point& along, double length) {
  const Point side(-along.y(), along.x());
  const double head = std::min(3.6, 0.6 * length);
  const Point left = -head * along + 0.55 * head * side, right = -head * along - 0.55 * head * side;
  return "M" + pair(middle - 0.5 * length * along) + "l" + pair(length * along) + "l" + pair(left) + "m" + pair(-left) +
         "l" + pair(right);
}

void draw_arrows(pugi::xml_node parent, const ForceField& field, const svg::View& view) {
  std::string data;
  const double cell = map_square / field.columns;
  const int stride = std::max(1, static_cast<int>(std::lround(arrow_spacing / cell)));
  for (int row = stride / 2; row < field.columns; row += stride) {
    for (int column = stride / 2; column < field.columns; column += stride) {
      const Point force = field.force(column, row);
      const double length = std::min(force.norm() / fullest, 1.0) * max_arrow;
      if (length < 0.8) continue;
      data += arrow(view(field.place(column, row)), Point(force.x(), -force.y()).normalized(), length);
    }
  }
  if (data.empty()) return;
  add(parent, "path",
      {{"class", "arrows"}, {"d", data}, {"stroke", field_ink}, {"stroke-width", "0.75"}, {"fill", "none"}});
}

/// Whether the hand feels the jump as one: where a feature point is passed, guidance may fade in.
bool is_felt(const ForceJump& jump, const ForceFieldFigure::Panel& panel) {
  return !(jump.passes_feature && panel.fades_in);
}

void draw_jumps(pugi::xml_node parent, const ForceFieldFigure::Panel& panel, const svg::View& view) {
  svg::Path felt, faded;
  for (const ForceJump& jump : panel.field.jumps) {
    svg::Path& path = is_felt(jump, panel) ? felt : faded;
    path.move_to(rounded(view(jump.begin)));
    path.line_to(rounded(view(jump.end)));
  }
  const auto draw = [parent](const svg::Path& path, const char* name, const char* colour) {
    if (path.data().empty()) return;
    add(parent, "path",
        {{"class", name},
         {"d", path.data()},
         {"stroke", colour},
         {"stroke-width", "2"},
         {"stroke-linecap", "round"},
         {"fill", "none"}});
  };
  draw(faded, "passages", passage_orange);
  draw(felt, "jumps", jump_red);
}

/// How large the jumps are, and how far from the stroke a pen may stray before it meets one.
std::string note_on_jumps(const ForceFieldFigure::Panel& panel) {
  double largest = 0.0, nearest = std::numeric_limits<double>::infinity();
  bool passes = false;
  for (const ForceJump& jump : panel.field.jumps) {
    passes = passes || !is_felt(jump, panel);
    if (!is_felt(jump, panel)) continue;
    largest = std::max(largest, jump.size);
    nearest = std::min(nearest, jump.from_stroke);
  }
  if (!(largest > 0.0)) return passes ? "no jump except where the feature point is passed" : "no jump";
  char note[96];
  std::snprintf(note, sizeof note, "jumps up to %.1f N, from %.1f mm off the stroke", largest, millimetres * nearest);
  return note;
}

void draw_strokes(pugi::xml_node parent, const ForceFieldFigure& figure, const svg::View& view) {
  const std::vector<Stroke> all = strokes(figure.placed.character);
  const Placement& placement = figure.placed.placement;
  const svg::View em_view{view(placement.origin), view.scale * placement.em};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool active = static_cast<int>(i) == figure.stroke;
    add(parent, "path",
        {{"class", active ? "active" : "other"},
         {"d", svg::stroke_path(all[i], em_view)},
         {"stroke", active ? active_blue : other_grey},
         {"stroke-width", active ? "3.2" : "2.4"},
         {"stroke-linecap", "round"},
         {"stroke-linejoin", "round"},
         {"fill", "none"}});
  }
}

void draw_pen(pugi::xml_node parent, const Point& at) {
  svg::add_circle(parent, "pen", at, "5", {{"fill", pen_yellow}, {"stroke", field_ink}, {"stroke-width", "1.2"}});
}

void draw_panel(pugi::xml_node root, const ForceFieldFigure& figure, std::size_t index) {
  const ForceFieldFigure::Panel& panel = figure.panels[index];
  const Point corner(map_margin + static_cast<double>(index) * (map_square + map_gap), map_top);
  const ForceField& field = panel.field;
  const double scale = map_square / field.edge;
  const svg::View view{corner + Point(0.0, map_square) - scale * Point(field.corner.x(), -field.corner.y()), scale};

  add_text(root, corner.x(), corner.y() - 8.0, 13.5, panel.name, {{"fill", field_ink}, {"font-weight", "bold"}});
  const std::string clip = "panel-" + std::to_string(index);
  svg::add_rect(add(root, "clipPath", {{"id", clip}}), corner, map_square, map_square);
  pugi::xml_node group = add(root, "g", {{"class", "field"}, {"clip-path", "url(#" + clip + ")"}});
  draw_sizes(group, field, corner);
  draw_strokes(group, figure, view);
  draw_jumps(group, panel, view);
  draw_arrows(group, field, view);
  draw_pen(group, view(figure.pen));
  svg::add_rect(root, corner, map_square, map_square, {{"fill", "none"}, {"stroke", field_faint}});

  add_text(root, corner.x(), corner.y() + map_square + 15.0, 12.0, note_on_jumps(panel), {{"fill", field_ink}});
}

double draw_line_key(pugi::xml_node root, double x, double y, const char* colour, double width, const char* text) {
  add(root, "path",
      {{"d", "M" + number(x) + "," + number(y) + "h22"}, {"stroke", colour}, {"stroke-width", number(width)}});
  add_text(root, x + 28.0, y + 4.0, 12.0, text, {{"fill", field_ink}});
  return x + 28.0 + svg::text_width(text, 12.0) + 14.0;
}

bool any_passage(const ForceFieldFigure& figure) {
  return std::any_of(figure.panels.begin(), figure.panels.end(), [](const ForceFieldFigure::Panel& panel) {
    return std::any_of(panel.field.jumps.begin(), panel.field.jumps.end(),
                       [&panel](const ForceJump& jump) { return !is_felt(jump, panel); });
  });
}

void draw_key(pugi::xml_node root, const ForceFieldFigure& figure, double y) {
  double x = map_margin;
  constexpr double swatch = 15.0;
  add_text(root, x, y + 4.0, 12.0, "force [N]", {{"fill", field_ink}});
  x += 62.0;
  const double step = fullest / static_cast<double>(colours.size());
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const double left = x + static_cast<double>(i) * swatch;
    svg::add_rect(root, {left, y - 7.0}, swatch, 12.0,
                  {{"fill", colours[i]}, {"stroke", field_faint}, {"stroke-width", "0.6"}});
    if (i % 2 == 0) {
      add_text(root, left, y + 17.0, 10.0, number(static_cast<double>(i) * step),
               {{"text-anchor", "middle"}, {"fill", field_ink}});
    }
  }
  x += swatch * static_cast<double>(colours.size());
  add_text(root, x - 3.0, y + 17.0, 10.0, number(fullest) + " and more", {{"fill", field_ink}});
  x += 22.0;
  x = draw_line_key(root, x, y, active_blue, 3.2, "stroke being written");
  if (figure.placed.character.stroke_count() > 1) x = draw_line_key(root, x, y, other_grey, 2.4, "other");
  draw_pen(root, {x + 8.0, y});
  add_text(root, x + 19.0, y + 4.0, 12.0, "written up to here", {{"fill", field_ink}});
  x += 19.0 + svg::text_width("written up to here", 12.0) + 10.0;
  x = draw_line_key(root, x, y, jump_red, 2.0, "the force jumps");
  if (any_passage(figure)) draw_line_key(root, x, y, passage_orange, 2.0, "feature point passed, fades in");
  const ForceField& field = figure.panels.front().field;
  const double bar = 5.0 / millimetres * map_square / field.edge;
  const double right = map_margin + static_cast<double>(figure.panels.size()) * (map_square + map_gap) - map_gap;
  add(root, "path",
      {{"d", "M" + number(right - bar) + "," + number(y - 4.0) + "v8m0,-4h" + number(bar) + "m0,-4v8"},
       {"stroke", field_ink},
       {"fill", "none"}});
  add_text(root, right - 0.5 * bar, y + 17.0, 11.0, "5 mm", {{"text-anchor", "middle"}, {"fill", field_ink}});
}

}  // namespace

std::string force_field_picture(const ForceFieldFigure& figure) {
  if (figure.panels.empty()) throw ValueError("force field picture: the figure has no panel");
  const auto count = static_cast<double>(figure.panels.size());
  const double width = 2.0 * map_margin + count * map_square + (count - 1.0) * map_gap;
  pugi::xml_document document;
  const std::string title = svg::clean(figure.title);
  pugi::xml_node root = svg::begin(document, width, map_top + map_square + note_height + key_height, "px", title);
  add_text(root, map_margin, 29.0, 18.0, title, {{"fill", field_ink}});
  for (std::size_t i = 0; i < figure.panels.size(); ++i) draw_panel(root, figure, i);
  draw_key(root, figure, map_top + map_square + note_height + 16.0);
  return svg::to_string(document);
}

}  // namespace calligraphy
