#include "marks.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include <calligraphy/judge/remark_text.hpp>

#include "judge/pens/resemblance.hpp"

namespace calligraphy::marks {
namespace {

constexpr std::size_t max_remarks = 12;

std::vector<Point> evenly_spaced(std::span<const Point> path) { return points_along(path, path_length(path), 32); }

Point tangent(const std::vector<Point>& points, std::size_t at) {
  const std::size_t next = std::min(at + 2, points.size() - 1);
  const Point along = points[next] - points[at];
  return along.norm() > 0.0 ? Point(along.normalized()) : Point(1.0, 0.0);
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

}  // namespace

void Labels::avoid(std::span<const Point> path) {
  const double length = path_length(path);
  const double count = std::min(std::ceil(4.0 * length / size_), 500.0);
  const std::vector<Point> points = points_along(path, length, static_cast<std::size_t>(count) + 2);
  ink_.insert(ink_.end(), points.begin(), points.end());
}

Point Labels::place(std::span<const Point> path, double width) {
  const std::vector<Point> points = evenly_spaced(path);
  Point best = points.front();
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t at : {std::size_t{0}, std::size_t{3}, std::size_t{6}, std::size_t{10}, std::size_t{15}}) {
    const Point along = tangent(points, at);
    const Point across(-along.y(), along.x());
    std::vector<Point> sides = {across, -across};
    if (at == 0) sides.insert(sides.end(), {-along, (across - along).normalized(), (-across - along).normalized()});
    for (const Point& side : sides) {
      for (const double away : {0.75, 1.1}) {
        const Point beside = points[at] + away * size_ * side;
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

double Labels::covered(const Point& centre, double width) const {
  double sum = 0.0;
  for (const Taken& other : taken_) {
    const double x = 0.5 * (width + other.width) + 0.12 * size_ - std::abs(centre.x() - other.centre.x());
    const double y = size_ - std::abs(centre.y() - other.centre.y());
    if (x > 0.0 && y > 0.0) sum += 1.0 + x * y;
  }
  const double half_width = 0.5 * width + 0.15 * size_, half_height = 0.5 * size_;
  for (const Point& point : ink_) {
    const Point away = (point - centre).cwiseAbs();
    if (away.x() < half_width && away.y() < half_height) sum += 0.1;
  }
  return sum;
}

pugi::xml_node add_lines(pugi::xml_node root, const char* name, double width) {
  return svg::add(root, "g",
                  {{"class", name},
                   {"fill", "none"},
                   {"stroke-width", svg::number(width)},
                   {"stroke-linecap", "round"},
                   {"stroke-linejoin", "round"}});
}

void draw_path(pugi::xml_node parent, std::span<const Point> points, const char* colour) {
  svg::add(parent, "path", {{"d", svg::line_path(points)}, {"stroke", colour}});
}

void draw_arrow(pugi::xml_node parent, std::span<const Point> points, const char* colour, double length) {
  if (path_length(points) < 1.5 * length) return;
  const std::vector<Point> even = evenly_spaced(points);
  const std::size_t middle = even.size() * 3 / 5;
  const Point along = even[middle + 1] - even[middle - 1];
  if (along.norm() == 0.0) return;
  const Point forward = 0.5 * length * along.normalized();
  const Point across(-0.6 * forward.y(), 0.6 * forward.x());
  const Point back = even[middle] - forward;
  const std::vector<Point> head = {even[middle] + forward, back + across, back - across};
  svg::add(parent, "path", {{"d", svg::polygon_path(head)}, {"fill", colour}, {"stroke", "none"}});
}

/// Halos are texts of their own, because not every viewer knows paint-order.
Numbers::Numbers(pugi::xml_node root, double size)
    : size_(size),
      halos_(svg::add(root, "g",
                      {{"class", "halo"},
                       {"text-anchor", "middle"},
                       {"font-weight", "bold"},
                       {"fill", "#ffffff"},
                       {"stroke", "#ffffff"},
                       {"stroke-width", svg::number(0.2 * size)}})),
      labels_(size) {}

pugi::xml_node Numbers::add_group(pugi::xml_node root, const char* name, const char* font_style) {
  return svg::add(
      root, "g",
      {{"class", name}, {"text-anchor", "middle"}, {"font-weight", "bold"}, {"font-style", font_style}});
}

void Numbers::draw(pugi::xml_node group, std::span<const Point> points, std::size_t number, const char* colour) {
  const std::string text = std::to_string(number);
  const Point centre = labels_.place(points, svg::text_width(text, size_));
  const double y = centre.y() + 0.35 * size_;
  svg::add_text(halos_, centre.x(), y, size_, text, {});
  svg::add_text(group, centre.x(), y, size_, text, {{"fill", colour}});
}

const char* colour_of(const MatchResult& match, std::size_t path) {
  if (has_remark(match, path, {StrokeRemarkKind::order, StrokeRemarkKind::direction, StrokeRemarkKind::extra}))
    return wrong;
  if (has_remark(match, path, {StrokeRemarkKind::joined, StrokeRemarkKind::broken, StrokeRemarkKind::shape}))
    return noted;
  return svg::ink;
}

bool is_missing(const MatchResult& match, std::size_t stroke) {
  const auto index = static_cast<int>(stroke);
  return std::any_of(match.remarks.begin(), match.remarks.end(), [index](const StrokeRemark& remark) {
    return remark.kind == StrokeRemarkKind::missing && remark.stroke <= index &&
           index < remark.stroke + std::max(remark.stroke_count, 1);
  });
}

bool bounced(const DrawnStroke& drawn) { return drawn.tap && drawn.stroke < 0; }

std::vector<std::string> remark_lines(const MatchResult& match, const Character& character, const Language& language) {
  std::vector<std::string> lines;
  for (const StrokeRemark& remark : match.remarks) lines.push_back(remark_text(remark, character, language));
  if (lines.size() <= max_remarks) return lines;
  const std::size_t more = lines.size() - max_remarks + 1;
  lines.resize(max_remarks - 1);
  lines.push_back(language.text("picture.more_remarks", {{"count", std::to_string(more)}}));
  return lines;
}

}  // namespace calligraphy::marks
