#include <calligraphy/pictures/picture.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/typical_ink.hpp>

#include "base/require.hpp"
#include "judge/pens/resemblance.hpp"
#include "marks.hpp"
#include "practice/pen_down.hpp"
#include "svg.hpp"
#include "thinned.hpp"

namespace calligraphy {
namespace {

using svg::add;
using svg::add_text;
using svg::number;

constexpr const char* missing_colour = "#f8cccc";  ///< of a template that was not written

// Relative to the em square.
constexpr double template_width = 0.07;   ///< as a line
constexpr double finest_detail = 0.0005;  ///< how far a drawn pen-down may differ from the recorded one
constexpr double square_margin = 0.06;    ///< around the square, for numbers
constexpr double ring_radius = 0.028;

constexpr std::size_t max_points = 15000;  ///< of all pen-downs, about 200 kB of text

// Of the picture of a character [mm].
constexpr double picture_side = 100.0;
constexpr double picture_border = 6.0;
constexpr double picture_top = 10.0;

struct PenLine {
  std::vector<Point> slide;  ///< to the start, before the writing began [em]
  std::vector<Point> path;   ///< [em]
  bool counted;              ///< as a stroke, or in progress
};

/// A character with what was written of it.
struct Writing {
  const Placement& placement;
  const MatchResult& match;
  Character character;             ///< with ink
  std::vector<PenLine> lines;      ///< as match.drawn
  std::optional<std::size_t> due;  ///< the stroke that was to be written when the recording ended
};

/// Where nothing was written at all, nothing is marked.
bool is_missing(const Writing& writing, std::size_t stroke) {
  return !writing.lines.empty() && marks::is_missing(writing.match, stroke);
}

/// Whether each pen-down wrote the stroke of its own number, and none is missing.
bool corresponds(const Writing& writing) {
  const std::vector<DrawnStroke>& drawn = writing.match.drawn;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (drawn[i].stroke != static_cast<int>(i)) return false;
  }
  return drawn.empty() || writing.match.count(StrokeRemarkKind::missing) == 0;
}

/// Which kinds of marks a picture has, for its legend.
struct Shown {
  bool written = false, wrong = false, noted = false, place = false, attempt = false;
  bool order = false, missing = false, due = false;
};

void require_valid(const PracticePage& page, std::span<const CharacterScore> scores) {
  require_above_zero("width of the page", page.width, "m");
  require_above_zero("height of the page", page.height, "m");
  validate(page.characters);
  if (scores.size() != page.characters.size()) {
    throw ValueError("scores: expected one for each of " + std::to_string(page.characters.size()) +
                     " characters of the page, got " + std::to_string(scores.size()));
  }
}

std::optional<std::size_t> due_stroke(const Recording& recording, std::size_t character, int stroke_count) {
  const RecordedSample start;
  const RecordedSample& last = recording.samples.empty() ? start : recording.samples.back();
  const bool is_active = last.character == static_cast<int>(character);
  if (!is_active || last.stroke < 0 || last.stroke >= stroke_count) return std::nullopt;
  return static_cast<std::size_t>(last.stroke);
}

std::vector<Writing> writings_of(const PracticePage& page, const Recording& recording,
                                 std::span<const CharacterScore> scores) {
  const std::vector<std::vector<PenDown>> downs = pen_downs_by_character(page, recording);
  std::vector<Writing> writings;
  for (std::size_t i = 0; i < page.characters.size(); ++i) {
    const PlacedCharacter& placed = page.characters[i];
    if (scores[i].match.drawn.size() != downs[i].size()) {
      throw ValueError("scores: character " + std::to_string(i) + " has " +
                       std::to_string(scores[i].match.drawn.size()) + " pen-downs, in the recording " +
                       std::to_string(downs[i].size()));
    }
    Writing& writing = writings.emplace_back(Writing{placed.placement, scores[i].match,
                                                     with_typical_ink(placed.character), {},
                                                     due_stroke(recording, i, placed.character.stroke_count())});
    for (const PenDown& down : downs[i]) {
      PenLine& line = writing.lines.emplace_back(PenLine{{}, {}, down.finished_stroke || !down.lifted});
      for (const TimedPoint& sample : down.samples) {
        line.path.push_back((sample.point - placed.placement.origin) / placed.placement.em);
      }
      const auto begin = static_cast<std::ptrdiff_t>(line.counted ? writing_begin(down, page, recording) : 0);
      if (begin == 0) continue;
      line.slide.assign(line.path.begin(), line.path.begin() + begin + 1);
      line.path.erase(line.path.begin(), line.path.begin() + begin);
    }
  }
  return writings;
}

/// Leaves out invisible detail, and more still if the picture would be too large.
void thin(std::span<Writing> writings) {
  for (double detail = finest_detail; detail < 4.0; detail *= 2.0) {
    std::size_t points = 0;
    for (Writing& writing : writings) {
      for (PenLine& line : writing.lines) {
        line.slide = thinned(line.slide, detail);
        line.path = thinned(line.path, detail);
        points += line.slide.size() + line.path.size();
      }
    }
    if (points <= max_points) return;
  }
}

/// The square in which a character stands, with its middle lines and diagonals, as on practice paper.
void draw_square(pugi::xml_node root, const svg::View& em) {
  pugi::xml_node parent = add(root, "g",
                              {{"class", "square"},
                               {"fill", "none"},
                               {"stroke", svg::faint},
                               {"stroke-width", number(0.003 * em.scale)}});
  const Point corner = em({0.0, 1.0}), end = em({1.0, 0.0}), middle = em({0.5, 0.5});
  svg::add_rect(parent, corner, em.scale, em.scale);
  svg::Path path;
  for (const auto& [from, to] : {std::pair{Point(corner.x(), middle.y()), Point(end.x(), middle.y())},
                                 {Point(middle.x(), corner.y()), Point(middle.x(), end.y())},
                                 {corner, end},
                                 {em({0.0, 0.0}), em({1.0, 1.0})}}) {
    path.move_to(from);
    path.line_to(to);
  }
  add(parent, "path", {{"d", path.data()}, {"stroke-dasharray", number(0.02 * em.scale)}});
}

void draw_template(pugi::xml_node root, const Writing& writing, StrokeStyle style, const svg::View& em) {
  draw_square(root, em);
  const double width = template_width * em.scale;
  pugi::xml_node group = svg::add_stroke_group(root, "template", style, marks::template_colour, width);
  const std::vector<Stroke> all = strokes(writing.character);
  for (std::size_t i = 0; i < all.size(); ++i) {
    svg::add_stroke(group, all[i], style, em);
    if (!is_missing(writing, i)) continue;
    const char* const paint = style == StrokeStyle::ink ? "fill" : "stroke";
    group.last_child().append_attribute(paint) = missing_colour;
  }
}

void draw_pen(pugi::xml_node root, const Writing& writing, const svg::View& em, const marks::Sizes& sizes,
              Shown& shown) {
  pugi::xml_node attempts = marks::add_lines(root, "attempt", 0.7 * sizes.line);
  attempts.append_attribute("stroke-dasharray") = (number(2.5 * sizes.line) + " " + number(2.0 * sizes.line)).c_str();
  attempts.append_attribute("opacity") = "0.6";
  pugi::xml_node slides = marks::add_lines(root, "slide", 0.5 * sizes.line);
  slides.append_attribute("opacity") = "0.4";
  pugi::xml_node traces = marks::add_lines(root, "trace", sizes.line);
  marks::Numbers numbers(root, sizes.label);
  pugi::xml_node drawn = numbers.add_group(root, "drawn-number", "normal");
  const std::vector<DrawnStroke>& wrote = writing.match.drawn;
  for (const PenLine& line : writing.lines) {
    if (line.counted) numbers.labels().avoid(em(line.path));
    if (!line.slide.empty()) numbers.labels().avoid(em(line.slide));
  }
  const std::vector<Point> places = marks::places_of_form(writing.match);
  marks::draw_rings(traces, em(places), sizes, numbers.labels());
  shown.place |= !places.empty();
  for (std::size_t i = 0; i < writing.lines.size(); ++i) {
    const PenLine& line = writing.lines[i];
    const std::vector<Point> points = em(line.path);
    const char* const colour = marks::colour_of(writing.match, i);
    pugi::xml_node group = line.counted ? traces : attempts;
    if (!line.slide.empty()) marks::draw_path(slides, em(line.slide), colour);
    marks::draw_path(group, points, colour);
    (line.counted ? shown.written : shown.attempt) = true;
    shown.wrong |= colour == marks::wrong;
    shown.noted |= colour == marks::noted;
    if (!line.counted && marks::bounced(wrote[i])) continue;
    marks::draw_arrow(group, points, colour, sizes.arrow);
    numbers.draw(drawn, points, i + 1, colour);
  }
  if (!corresponds(writing)) {
    shown.order = true;
    pugi::xml_node standard = numbers.add_group(root, "standard-number", "italic");
    const std::vector<std::vector<Point>> templates = middle_lines(writing.character);
    for (std::size_t i = 0; i < templates.size(); ++i) {
      const bool missing = is_missing(writing, i);
      shown.missing |= missing;
      numbers.draw(standard, em(templates[i]), i + 1, missing ? marks::wrong : marks::number_colour);
    }
  }
  if (!writing.due) return;
  shown.due = true;
  svg::add_circle(root, "start", em(strokes(writing.character)[*writing.due].control_points[0]),
                  number(ring_radius * em.scale).c_str(),
                  {{"fill", "none"}, {"stroke", marks::number_colour}, {"stroke-width", number(sizes.line)}});
}

void draw_title(pugi::xml_node root, double middle, double y, double size, double width, const std::string& heading) {
  const double fitting = width / svg::text_width(heading + ".", 1.0);
  add_text(root, middle, y, std::min(size, fitting), heading, {{"text-anchor", "middle"}, {"fill", svg::ink}});
}

/// A place for lines of text, from its upper left corner downwards, in steps of `unit` [mm].
struct TextColumn {
  pugi::xml_node parent;
  double left, width, unit;
  double y;  ///< of the last line

  double size() const { return 3.2 * unit; }
  double line_height() const { return 4.9 * unit; }
};

/// What the marks in a picture mean, as many beside each other as there is room for.
void draw_legend(TextColumn& column, const Shown& shown, const Language& language) {
  const double sample = 7.0 * column.unit, space = 1.5 * column.unit, gap = 5.0 * column.unit;
  double x = column.left;
  column.y += column.line_height();
  /// Makes room for an entry, and returns the points of its sample.
  const auto begin = [&](const char* key) {
    const std::string text = language.text(key);
    const double width = sample + space + svg::text_width(text, column.size());
    if (x > column.left && x + width > column.left + column.width) {
      x = column.left;
      column.y += column.line_height();
    }
    add_text(column.parent, x + sample + space, column.y, column.size(), text);
    const double middle = column.y - 0.35 * column.size();
    const std::vector<Point> points = {{x, middle}, {x + sample, middle}};
    x += width + gap;
    return points;
  };
  const auto line = [&](const char* key, const char* colour, double width, const char* dashes = "none") {
    const std::vector<Point> points = begin(key);
    add(column.parent, "path",
        {{"d", svg::line_path(points)},
         {"stroke", colour},
         {"stroke-width", number(width * column.unit)},
         {"stroke-dasharray", dashes}});
    if (width < 1.0) marks::draw_arrow(column.parent, points, colour, 2.4 * column.unit);
  };
  line("picture.template", marks::template_colour, 2.8);
  if (shown.written) line("picture.written", svg::ink, 0.7);
  if (shown.wrong) line("picture.wrong", marks::wrong, 0.7);
  if (shown.noted) line("picture.noted", marks::noted, 0.7);
  const std::string dashes = number(1.7 * column.unit) + " " + number(1.3 * column.unit);
  if (shown.attempt) line("picture.attempt", "#999999", 0.5, dashes.c_str());
  if (shown.missing) line("picture.missing", missing_colour, 2.8);
  if (shown.order) {
    const std::vector<Point> points = begin("picture.order");
    add_text(column.parent, 0.5 * (points[0].x() + points[1].x()), column.y, column.size(), "1 2",
             {{"text-anchor", "middle"},
              {"font-weight", "bold"},
              {"font-style", "italic"},
              {"fill", marks::number_colour}});
  }
  const auto ring = [&](const char* key, const char* name, const char* colour) {
    const std::vector<Point> points = begin(key);
    svg::add_circle(column.parent, name, 0.5 * (points[0] + points[1]), number(1.5 * column.unit).c_str(),
                    {{"fill", "none"}, {"stroke", colour}, {"stroke-width", number(0.6 * column.unit)}});
  };
  if (shown.place) ring("picture.place", "place-sample", marks::noted);
  if (shown.due) ring("picture.start", "start-sample", marks::number_colour);
}

void draw_remarks(TextColumn& column, const CharacterScore& score, const Language& language) {
  std::vector<std::string> remarks = marks::remark_lines(score.match, score.match.character, language);
  if (remarks.empty() && score.strokes_written == score.stroke_count) {
    remarks.push_back(language.text("picture.no_remark"));
  }
  column.y += 0.4 * column.line_height();
  for (const std::string& remark : remarks) {
    for (const std::string& line : svg::wrapped(remark, column.size(), column.width)) {
      column.y += column.line_height();
      add_text(column.parent, column.left, column.y, column.size(), line);
    }
  }
}

/// Shows the square, and more if the pen left it, in the picture of a character.
svg::View view_of(const Writing& writing) {
  Eigen::AlignedBox2d box(Point::Constant(-square_margin), Point::Constant(1.0 + square_margin));
  for (const PenLine& line : writing.lines) {
    for (const std::vector<Point>& part : {line.slide, line.path}) {
      for (const Point& point : part) {
        box.extend(point + Point::Constant(square_margin));
        box.extend(point - Point::Constant(square_margin));
      }
    }
  }
  const double scale = picture_side / box.sizes().maxCoeff();
  const Point middle(picture_border + 0.5 * picture_side, picture_top + 0.5 * picture_side);
  return {middle - scale * Point(box.center().x(), -box.center().y()), scale};
}

/// Sets the height of a picture, which follows from its text.
void set_height(pugi::xml_node root, double width, double height, const char* unit) {
  root.attribute("height") = (number(height) + unit).c_str();
  root.attribute("viewBox") = ("0 0 " + number(width) + " " + number(height)).c_str();
}

}  // namespace

std::string character_picture(const PracticePage& page, const Recording& recording,
                              std::span<const CharacterScore> scores, int index, const std::string& title,
                              StrokeStyle style, const Language& language) {
  const int count = static_cast<int>(page.characters.size());
  if (index < 0 || index >= count) {
    throw ValueError("character " + std::to_string(index) + ": the page has " + std::to_string(count));
  }
  require_valid(page, scores);
  const std::string heading = svg::clean(title);
  const auto at = static_cast<std::size_t>(index);
  std::vector<Writing> writings = writings_of(page, recording, scores);
  Writing& writing = writings[at];
  thin({&writing, 1});

  constexpr double width = picture_side + 2.0 * picture_border;
  pugi::xml_document document;
  pugi::xml_node root = svg::begin(document, width, width, "mm", heading);
  draw_title(root, 0.5 * width, 8.5, 5.0, picture_side, heading);
  const svg::View em = view_of(writing);
  const marks::Sizes sizes = {.line = 0.6, .label = 3.4, .arrow = 2.8};
  Shown shown;
  draw_template(root, writing, style, em);
  draw_pen(root, writing, em, sizes, shown);

  pugi::xml_node legend = add(root, "g", {{"class", "legend"}, {"fill", svg::ink}});
  TextColumn column = {legend, picture_border, picture_side, 1.0, picture_top + picture_side};
  draw_legend(column, shown, language);
  column.parent = add(root, "g", {{"class", "remarks"}, {"fill", svg::ink}});
  if (!writing.lines.empty()) draw_remarks(column, scores[at], language);
  set_height(root, width, column.y + 4.0, "mm");
  return svg::to_string(document);
}

std::string page_picture(const PracticePage& page, const Recording& recording, std::span<const CharacterScore> scores,
                         const std::string& title, StrokeStyle style, const Language& language) {
  require_valid(page, scores);
  const std::string heading = svg::clean(title);
  std::vector<Writing> writings = writings_of(page, recording, scores);
  thin(writings);
  const double width = 1e3 * page.width, height = 1e3 * page.height;  // [mm]
  const double unit = width / 160.0;                                  // text and margins grow with the page
  const double side = 6.0 * unit, top = 12.0 * unit;
  const svg::View view{{side, top + height}, 1e3};

  pugi::xml_document document;
  pugi::xml_node root = svg::begin(document, width + 2.0 * side, height, "mm", heading);
  draw_title(root, side + 0.5 * width, 8.0 * unit, 5.0 * unit, width, heading);
  svg::add_rect(root, {side, top}, width, height,
                {{"class", "page"}, {"fill", "none"}, {"stroke", "#bbbbbb"}, {"stroke-width", number(0.4 * unit)}});
  const auto place = [&view](const Writing& writing) {
    return svg::View{view(writing.placement.origin), view.scale * writing.placement.em};
  };
  Shown shown;
  for (const Writing& writing : writings) draw_template(root, writing, style, place(writing));
  for (const Writing& writing : writings) {
    const svg::View em = place(writing);
    draw_pen(root, writing, em, {.line = 0.01 * em.scale, .label = 0.05 * em.scale, .arrow = 0.04 * em.scale}, shown);
  }
  pugi::xml_node legend = add(root, "g", {{"class", "legend"}, {"fill", svg::ink}});
  TextColumn column = {legend, side, width, unit, top + height + unit};
  draw_legend(column, shown, language);
  set_height(root, width + 2.0 * side, column.y + 3.0 * unit, "mm");
  return svg::to_string(document);
}

}  // namespace calligraphy
