#include <calligraphy/pictures/picture.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/ink_outline.hpp>
#include <calligraphy/model/typical_ink.hpp>

#include "base/require.hpp"
#include "svg.hpp"
#include "thinned.hpp"

namespace calligraphy {
namespace {

using svg::add;
using svg::add_text;
using svg::faint;
using svg::ink;
using svg::number;

// Blue, yellow, light green and red are the paper's (sec. 7.2), in shades that differ on white and on each other.
constexpr const char* template_blue = "#5b8ff0";
constexpr const char* active_yellow = "#f2b705";
constexpr const char* trace_green = "#5fce5f";
constexpr const char* start_red = "#e02020";

// Relative to the em square.
constexpr double stroke_width = 0.07;
constexpr double trace_width = 0.022;
constexpr double trace_share = 0.6;       ///< of the template's ink width, so that its edge shows round the trace
constexpr double longest_ink = 8.0;       ///< [em]
constexpr double finest_detail = 0.0005;  ///< how far a drawn trace may differ from the recorded one

constexpr std::size_t max_trace_points = 15000;  ///< about 200 kB of text

/// What the pen has drawn of a stroke, up to its present position if the stroke is not finished.
struct Trace {
  std::vector<Point> path;  ///< [em] of the character
  int stroke = 0;           ///< index within the character
  bool finished = false;
};

/// The traces of each character up to `active`, without those of abandoned attempts.
std::vector<std::vector<Trace>> traces_until(const PracticePage& page, const Recording& recording, int active) {
  std::vector<std::vector<Trace>> result(static_cast<std::size_t>(active) + 1);
  Trace trace;                 // [m, page] until it is kept
  std::vector<Point> touched;  // since the pen was put down, until it is known what it writes
  int character = -1;
  const auto extend = [](std::vector<Point>& line, const RecordedSample& sample) {
    if (has_position(sample.status) && sample.pen_tip.allFinite()) line.push_back(sample.pen_tip.head<2>());
  };
  const auto keep = [&] {
    if (character >= 0 && character <= active && !trace.path.empty()) {
      const auto index = static_cast<std::size_t>(character);
      const Placement& placement = page.characters[index].placement;
      for (Point& point : trace.path) point = (point - placement.origin) / placement.em;
      result[index].push_back(trace);
    }
    trace = {};
    touched.clear();
    character = -1;
  };
  for (const RecordedSample& sample : recording.samples) {
    if (has_event(sample.events, TickEvent::contact)) touched.clear();
    if (sample.state == InteractionState::writing) {
      if (character < 0) {
        character = sample.character;
        trace = {touched, sample.stroke};
      }
      extend(trace.path, sample);
    } else if (character >= 0) {
      trace.finished = has_event(sample.events, TickEvent::stroke_finished);
      if (trace.finished) extend(trace.path, sample);
      if (has_event(sample.events, TickEvent::stroke_abandoned)) trace.path.clear();
      keep();
    } else if (sample.state != InteractionState::separation) {
      extend(touched, sample);
    }
  }
  keep();
  return result;
}

/// The drawn form of a trace [em].
struct TraceShape {
  std::vector<Point> points;
  bool filled;  ///< the outline of ink, not a line
};

/// A trace becomes a line if its stroke is not finished, since the profile is that of the whole stroke, or if the pen
/// went to and fro so long that the ink would be a blot.
TraceShape shape_of(const Trace& trace, std::span<const Stroke> strokes, StrokeStyle style, double detail) {
  std::vector<Point> path = thinned(trace.path, detail);
  const bool known = trace.finished && trace.stroke >= 0 && trace.stroke < static_cast<int>(strokes.size());
  if (style == StrokeStyle::lines || !known || path_length(trace.path) > longest_ink) return {std::move(path), false};
  StrokeInk profile = *strokes[static_cast<std::size_t>(trace.stroke)].ink;
  for (double& half_width : profile.half_widths) half_width *= trace_share;
  return {ink_outline(path, profile, detail), true};
}

/// The shapes without invisible detail, and with less detail still if the picture would be too large.
std::vector<std::vector<TraceShape>> shapes_of(std::vector<std::vector<Trace>> traces,
                                               const std::vector<std::vector<Stroke>>& strokes, StrokeStyle style) {
  for (std::vector<Trace>& of_character : traces) {
    for (Trace& trace : of_character) trace.path = thinned(trace.path, finest_detail);
  }
  for (double detail = finest_detail;; detail *= 2.0) {
    std::vector<std::vector<TraceShape>> shapes(traces.size());
    std::size_t points = 0;
    for (std::size_t character = 0; character < traces.size(); ++character) {
      for (const Trace& trace : traces[character]) {
        shapes[character].push_back(shape_of(trace, strokes[character], style, detail));
        points += shapes[character].back().points.size();
      }
    }
    if (points <= max_trace_points || detail > 1.0) return shapes;
  }
}

void draw_traces(pugi::xml_node root, const std::vector<TraceShape>& shapes, const svg::View& em) {
  pugi::xml_node group = add(root, "g",
                             {{"class", "trace"},
                              {"stroke-width", number(trace_width * em.scale)},
                              {"stroke-linecap", "round"},
                              {"stroke-linejoin", "round"}});
  for (const TraceShape& shape : shapes) {
    const std::vector<Point> points = em(shape.points);
    if (shape.filled) {
      add(group, "path", {{"d", svg::polygon_path(points)}, {"fill", trace_green}});
    } else {
      add(group, "path", {{"d", svg::line_path(points)}, {"fill", "none"}, {"stroke", trace_green}});
    }
  }
}

/// The last active stroke of the active character; its last stroke once it is complete.
std::size_t last_active_stroke(const Recording& recording, int active, int stroke_count) {
  int stroke = 0;
  for (const RecordedSample& sample : recording.samples) {
    if (sample.character == active) stroke = sample.stroke;
  }
  return static_cast<std::size_t>(std::clamp(stroke, 0, stroke_count - 1));
}

svg::View view_of(const Placement& placement, const svg::View& page) {
  return {page(placement.origin), page.scale * placement.em};
}

/// The square in which a character stands, with its middle lines, as on practice paper.
void draw_square(pugi::xml_node parent, const svg::View& em) {
  const Point corner = em({0.0, 1.0});
  svg::add_rect(parent, corner, em.scale, em.scale);
  const Point middle = em({0.5, 0.5});
  const Point end = em({1.0, 0.0});
  add(parent, "path",
      {{"d", "M" + number(corner.x()) + "," + number(middle.y()) + "H" + number(end.x()) + "M" + number(middle.x()) +
                 "," + number(corner.y()) + "V" + number(end.y())},
       {"stroke-dasharray", number(0.03 * em.scale)}});
}

/// What each colour means, in one line below the page.
void draw_legend(pugi::xml_node root, StrokeStyle style, double middle, double y, double unit,
                 const Language& language) {
  struct Entry {
    const char* colour;
    std::string text;
    double width;
  };
  const double trace = style == StrokeStyle::ink ? 2.6 * trace_share : 0.9;
  const std::array<Entry, 3> lines = {{{template_blue, language.text("picture.template"), 2.6},
                                       {active_yellow, language.text("picture.active"), 2.6},
                                       {trace_green, language.text("picture.trace"), trace}}};
  const std::string start = language.text("picture.start");
  const double size = 3.3 * unit, sample = 7.0 * unit, space = 1.5 * unit, gap = 6.0 * unit;

  double total = svg::text_width(start, size) + sample + space;
  for (const Entry& entry : lines) total += svg::text_width(entry.text, size) + sample + space + gap;
  double x = middle - 0.5 * total;
  const double line_y = y - 0.35 * size;
  pugi::xml_node legend = add(root, "g", {{"class", "legend"}, {"fill", ink}});
  for (const Entry& entry : lines) {
    add(legend, "line",
        {{"x1", number(x)},
         {"y1", number(line_y)},
         {"x2", number(x + sample)},
         {"y2", number(line_y)},
         {"stroke", entry.colour},
         {"stroke-width", number(entry.width * unit)}});
    x += sample + space;
    add_text(legend, x, y, size, entry.text);
    x += svg::text_width(entry.text, size) + gap;
  }
  add(legend, "ellipse",
      {{"cx", number(x + 0.5 * sample)},
       {"cy", number(line_y)},
       {"rx", number(0.4 * sample)},
       {"ry", number(0.25 * sample)},
       {"fill", "none"},
       {"stroke", start_red},
       {"stroke-width", number(0.7 * unit)}});
  add_text(legend, x + sample + space, y, size, start);
}

void require_valid(const PracticePage& page, int active) {
  require_above_zero("width of the page", page.width, "m");
  require_above_zero("height of the page", page.height, "m");
  const int count = static_cast<int>(page.characters.size());
  if (active < 0 || active >= count) {
    throw ValueError("active character " + std::to_string(active) + ": the page has " + std::to_string(count));
  }
  for (int i = 0; i < count; ++i) {
    const std::vector<ValidationIssue> problems = validate(page.characters[static_cast<std::size_t>(i)].character);
    if (!problems.empty()) throw ValueError("character " + std::to_string(i) + " of the page: " + problems[0].what);
  }
}

}  // namespace

std::string page_picture(const PracticePage& page, const Recording& recording, int active, const std::string& title,
                         StrokeStyle style, const Language& language) {
  require_valid(page, active);
  const int count = static_cast<int>(page.characters.size());
  const std::string heading = svg::clean(title);
  const double width = 1e3 * page.width, height = 1e3 * page.height;  // [mm]
  const double unit = width / 160.0;                                  // text and margins grow with the page
  const double side = 6.0 * unit, top = 12.0 * unit, bottom = 9.0 * unit;
  const svg::View view{{side, top + height}, 1e3};

  pugi::xml_document document;
  pugi::xml_node root = svg::begin(document, width + 2.0 * side, height + top + bottom, "mm", heading);
  const double middle = side + 0.5 * width;
  const double size = 5.0 * unit * std::min(1.0, width / (5.0 * unit * svg::text_width(heading + ".", 1.0)));
  add_text(root, middle, 8.0 * unit, size, heading, {{"text-anchor", "middle"}, {"fill", ink}});
  add(root, "rect",
      {{"class", "page"},
       {"x", number(side)},
       {"y", number(top)},
       {"width", number(width)},
       {"height", number(height)},
       {"fill", "none"},
       {"stroke", "#bbbbbb"},
       {"stroke-width", number(0.4 * unit)}});

  pugi::xml_node squares = add(root, "g", {{"fill", "none"}, {"stroke", faint}, {"stroke-width", number(0.2 * unit)}});
  for (const PlacedCharacter& placed : page.characters) draw_square(squares, view_of(placed.placement, view));

  std::vector<Character> characters;  // with ink
  std::vector<std::vector<Stroke>> all_strokes;
  for (const PlacedCharacter& placed : page.characters) characters.push_back(with_typical_ink(placed.character));
  for (int i = 0; i < count; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const svg::View em = view_of(page.characters[index].placement, view);
    pugi::xml_node group =
        svg::add_stroke_group(root, i == active ? "template active" : "template", style,
                              i == active ? active_yellow : template_blue, stroke_width * em.scale);
    all_strokes.push_back(strokes(characters[index]));
    for (const Stroke& stroke : all_strokes.back()) svg::add_stroke(group, stroke, style, em);
  }

  const auto shapes = shapes_of(traces_until(page, recording, active), all_strokes, style);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (!shapes[i].empty()) draw_traces(root, shapes[i], view_of(page.characters[i].placement, view));
  }

  const auto& active_strokes = all_strokes[static_cast<std::size_t>(active)];
  const Placement& placement = page.characters[static_cast<std::size_t>(active)].placement;
  const std::size_t stroke = last_active_stroke(recording, active, static_cast<int>(active_strokes.size()));
  const svg::View em = view_of(placement, view);
  const Point start = em(active_strokes[stroke].control_points[0]);
  add(root, "ellipse",
      {{"class", "start"},
       {"cx", number(start.x())},
       {"cy", number(start.y())},
       {"rx", number(0.075 * em.scale)},
       {"ry", number(0.052 * em.scale)},
       {"fill", "none"},
       {"stroke", start_red},
       {"stroke-width", number(0.018 * em.scale)}});

  draw_legend(root, style, middle, top + height + 6.2 * unit, unit, language);
  return svg::to_string(document);
}

}  // namespace calligraphy
