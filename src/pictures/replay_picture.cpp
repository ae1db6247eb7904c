#include <calligraphy/pictures/replay_picture.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/typical_ink.hpp>

#include "judge/pens/resemblance.hpp"
#include "svg.hpp"

namespace calligraphy {
namespace {

using svg::add;
using svg::add_text;
using svg::faint;
using svg::ink;

constexpr const char* template_colour = "#c5d6f7";
constexpr const char* number_colour = "#2f62c9";
constexpr const char* wrong = "#e02020";
constexpr const char* noted = "#e08a00";
constexpr const char* device_colour = "#2f9e44";

// [mm]
constexpr double sheet_margin = 6.0;
constexpr double square_side = 86.0;           ///< of a square
constexpr double sheet_top = 19.0;             ///< title and headings
constexpr double border = 0.09 * square_side;  ///< within the square, around the drawing: space for numbers
constexpr double text_size = 3.4;
constexpr double line_height = 4.6;
constexpr double label_size = 3.4;
constexpr double arrow_length = 2.4;

constexpr std::size_t max_lines = 12;  ///< of remarks

std::vector<Point> evenly_spaced(std::span<const Point> path) { return points_along(path, path_length(path), 32); }

/// Puts numbers beside paths where they cover each other least.
class Labels {
 public:
  /// Beside a path, near its start if there is room.
  Point place(std::span<const Point> path, double width) {
    const std::vector<Point> points = evenly_spaced(path);
    Point best = points.front();
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t at : {std::size_t{0}, std::size_t{3}, std::size_t{6}, std::size_t{10}, std::size_t{15}}) {
      const Point along = tangent(points, at);
      for (const double turn : {1.0, -1.0}) {
        for (const double away : {0.75, 1.1}) {
          const Point beside = points[at] + away * label_size * turn * Point(-along.y(), along.x());
          const double cost = covered(beside, width) + 0.02 * static_cast<double>(at) + 0.1 * away;
          if (cost >= least) continue;
          least = cost;
          best = beside;
        }
      }
    }
    taken_.push_back({best, width});
    return best;
  }

 private:
  struct Taken {
    Point centre;
    double width;
  };

  static Point tangent(const std::vector<Point>& points, std::size_t at) {
    const std::size_t next = std::min(at + 2, points.size() - 1);
    const Point along = points[next] - points[at];
    return along.norm() > 0.0 ? Point(along.normalized()) : Point(1.0, 0.0);
  }

  double covered(const Point& centre, double width) const {
    double sum = 0.0;
    for (const Taken& other : taken_) {
      const double x = 0.5 * (width + other.width) + 0.4 - std::abs(centre.x() - other.centre.x());
      const double y = label_size - std::abs(centre.y() - other.centre.y());
      if (x > 0.0 && y > 0.0) sum += 1.0 + x * y;
    }
    return sum;
  }

  std::vector<Taken> taken_;
};

void draw_path(pugi::xml_node parent, std::span<const Point> points, const char* colour) {
  add(parent, "path", {{"d", svg::line_path(points)}, {"stroke", colour}});
}

/// A head in the middle of the path that shows where it goes.
void draw_arrow(pugi::xml_node parent, std::span<const Point> points, const char* colour) {
  const std::vector<Point> even = evenly_spaced(points);
  const std::size_t middle = even.size() * 3 / 5;
  const Point along = even[middle + 1] - even[middle - 1];
  if (along.norm() == 0.0) return;
  const Point forward = 0.5 * arrow_length * along.normalized();
  const Point across(-0.6 * forward.y(), 0.6 * forward.x());
  const Point back = even[middle] - forward;
  const std::vector<Point> head = {even[middle] + forward, back + across, back - across};
  add(parent, "path", {{"d", svg::polygon_path(head)}, {"fill", colour}, {"stroke", "none"}});
}

/// The halo is a text of its own below all numbers, because not every viewer knows paint-order.
void draw_label(pugi::xml_node parent, pugi::xml_node halos, Labels& labels, std::span<const Point> points,
                const std::string& text, const char* colour) {
  const double width = svg::text_width(text, label_size);
  const Point centre = labels.place(points, width);
  const double y = centre.y() + 0.35 * label_size;
  add_text(halos, centre.x(), y, label_size, text, {});
  add_text(parent, centre.x(), y, label_size, text, {{"fill", colour}});
}

bool is_about(const StrokeRemark& remark, int path) {
  if (remark.path <= path && path < remark.path + remark.path_count) return true;
  return remark.kind == StrokeRemarkKind::order && remark.other_path == path;
}

bool has_remark(const MatchResult& match, std::size_t path, std::initializer_list<StrokeRemarkKind> kinds) {
  return std::any_of(match.remarks.begin(), match.remarks.end(), [&](const StrokeRemark& remark) {
    return is_about(remark, static_cast<int>(path)) &&
           std::find(kinds.begin(), kinds.end(), remark.kind) != kinds.end();
  });
}

const char* colour_of(const MatchResult& match, std::size_t path) {
  if (has_remark(match, path, {StrokeRemarkKind::order, StrokeRemarkKind::direction, StrokeRemarkKind::extra}))
    return wrong;
  if (has_remark(match, path, {StrokeRemarkKind::joined, StrokeRemarkKind::broken, StrokeRemarkKind::shape}))
    return noted;
  return ink;
}

bool is_missing(const MatchResult& match, std::size_t stroke) {
  return std::any_of(match.remarks.begin(), match.remarks.end(), [stroke](const StrokeRemark& remark) {
    return remark.kind == StrokeRemarkKind::missing && remark.stroke == static_cast<int>(stroke);
  });
}

bool bounced(const DrawnStroke& drawn) { return drawn.tap && drawn.stroke < 0; }

/// Round all that is shown [em].
Eigen::AlignedBox2d box_of(const Character& character, std::span<const PenPath> laid, const MatchResult& match,
                           std::span<const PenPath> guided) {
  Eigen::AlignedBox2d box = bounding_box({character, {Point::Zero(), 1.0}});
  for (std::size_t i = 0; i < laid.size(); ++i) {
    if (bounced(match.drawn[i])) continue;
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
  pugi::xml_node group = svg::add_stroke_group(root, "template", style, template_colour, 0.035 * square_side);
  for (const Stroke& stroke : strokes(character)) svg::add_stroke(group, stroke, style, view);
}

pugi::xml_node add_lines(pugi::xml_node root, const char* name) {
  return add(root, "g",
             {{"class", name},
              {"fill", "none"},
              {"stroke-width", "0.6"},
              {"stroke-linecap", "round"},
              {"stroke-linejoin", "round"}});
}

void draw_written(pugi::xml_node root, const Character& character, std::span<const PenPath> paths,
                  const MatchResult& match, const svg::View& view) {
  pugi::xml_node lines = add_lines(root, "written");
  pugi::xml_node halos = add(root, "g",
                             {{"class", "halo"},
                              {"text-anchor", "middle"},
                              {"font-weight", "bold"},
                              {"fill", "#ffffff"},
                              {"stroke", "#ffffff"},
                              {"stroke-width", "0.7"}});
  const auto numbers_of = [&root](const char* name) {
    return add(root, "g", {{"class", name}, {"text-anchor", "middle"}, {"font-weight", "bold"}});
  };
  pugi::xml_node numbers = numbers_of("drawn-number");
  pugi::xml_node standard = numbers_of("standard-number");
  Labels labels;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (bounced(match.drawn[i])) continue;
    const std::vector<Point> points = view(paths[i]);
    const char* const colour = colour_of(match, i);
    draw_path(lines, points, colour);
    draw_arrow(lines, points, colour);
    draw_label(numbers, halos, labels, points, std::to_string(i + 1), colour);
  }
  const std::vector<std::vector<Point>> templates = middle_lines(character);
  for (std::size_t i = 0; i < templates.size(); ++i) {
    draw_label(standard, halos, labels, view(templates[i]), std::to_string(i + 1),
               is_missing(match, i) ? wrong : number_colour);
  }
}

void draw_guided(pugi::xml_node root, std::span<const PenPath> guided, const svg::View& view) {
  pugi::xml_node lines = add_lines(root, "guided");
  for (const PenPath& path : guided) draw_path(lines, view(path), device_colour);
}

std::vector<std::string> lines_of(const MatchResult& match, const Character& character, const Language& language) {
  std::vector<std::string> lines;
  for (const StrokeRemark& remark : match.remarks) lines.push_back(remark_text(remark, character, language));
  if (lines.empty()) lines.push_back(language.text("picture.no_remark"));
  if (lines.size() > max_lines) {
    const std::size_t more = lines.size() - max_lines + 1;
    lines.resize(max_lines - 1);
    lines.push_back(language.text("picture.more_remarks", {{"count", std::to_string(more)}}));
  }
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
