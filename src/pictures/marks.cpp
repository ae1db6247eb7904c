#include "marks.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <numbers>

#include <calligraphy/judge/remark_text.hpp>

#include "judge/pens/resemblance.hpp"

namespace calligraphy::marks {
namespace {

constexpr std::size_t max_remarks = 12;
constexpr double ring_radius = 0.6;  ///< over the size of a label

// Of arrows.
constexpr double chord_reach = 3.0;       ///< of the chord each way, in lengths of the head: about 0.1 em
constexpr double least_agreement = 0.8;   ///< cosine between the path under the head and the chord
constexpr double least_straightness = 0.6;
constexpr std::size_t quarter = 8;        ///< of a path, in steps
constexpr double preferred_place = 0.6;   ///< share of the path: clear of the number and of what crosses the middle

std::vector<Point> evenly_spaced(std::span<const Point> path) { return points_along(path, path_length(path), 32); }

Point tangent(const std::vector<Point>& points, std::size_t at) {
  const std::size_t next = std::min(at + 2, points.size() - 1);
  const Point along = points[next] - points[at];
  return along.norm() > 0.0 ? Point(along.normalized()) : Point(1.0, 0.0);
}

/// Where a path, followed from a point on it towards its end or its start, first is so far from that point; if nowhere,
/// its last point there.
struct Reach {
  Point point;
  double way;   ///< along the path
  bool leaves;  ///< the circle
};

template <class Iterator>
Reach reach(const Point& centre, Iterator next, Iterator end, double radius) {
  Point inside = centre;
  double way = 0.0;
  for (; next != end; ++next) {
    const Point step = *next - inside, from = inside - centre;
    if ((*next - centre).norm() < radius) {
      inside = *next;
      way += step.norm();
      continue;
    }
    // |from + t step| = radius, with the larger t
    const double a = step.squaredNorm(), b = from.dot(step), c = from.squaredNorm() - radius * radius;
    const double t = (std::sqrt(std::max(b * b - a * c, 0.0)) - b) / a;
    return {inside + t * step, way + t * step.norm(), true};
  }
  return {inside, way, false};
}

/// How a path passes one of its points, between where it comes within a radius and where it first leaves again.
struct Passage {
  Point chord;
  double straightness;  ///< length of the chord over that of the path, 1 of a line
  bool is_whole;  ///< no end of the path is within the radius
};

Passage passage(std::span<const Point> path, std::size_t before, const Point& centre, double radius) {
  const auto next = path.begin() + static_cast<std::ptrdiff_t>(before) + 1;
  const Reach out = reach(centre, next, path.end(), radius);
  const Reach in = reach(centre, std::make_reverse_iterator(next), std::make_reverse_iterator(path.begin()), radius);
  const Point chord = out.point - in.point;
  return {chord, chord.norm() / (in.way + out.way), in.leaves && out.leaves};
}

double cosine(const Point& a, const Point& b) {
  const double norms = a.norm() * b.norm();
  return norms > 0.0 ? a.dot(b) / norms : -1.0;
}

struct Head {
  Arrow arrow;
  double merit;  ///< of its place
};

/// A head at a point of a path, if the path under it runs as it does as a whole.
std::optional<Head> head_at(std::span<const Point> path, std::size_t before, const Point& middle, double length) {
  const Passage under = passage(path, before, middle, 0.5 * length);
  if (!under.is_whole || under.straightness < least_straightness) return std::nullopt;
  const Point chord = passage(path, before, middle, chord_reach * length).chord;
  const double agreement = cosine(under.chord, chord);
  if (chord.norm() < length || agreement < least_agreement) return std::nullopt;
  const Point direction = (under.chord.normalized() + chord.normalized()).normalized();
  return Head{{middle, direction}, agreement + under.straightness};
}

/// From a quarter of the path before a share of it to a quarter after.
Point quarters_about(const std::vector<Point>& even, double share) {
  const auto at = static_cast<std::size_t>(share * 4.0 * quarter);
  return even[std::min(at + quarter, 4 * quarter)] - even[at - std::min(at, quarter)];
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

std::optional<Arrow> arrow_on(std::span<const Point> path, double length) {
  const double whole = path_length(path);
  if (!(whole >= 1.5 * length)) return std::nullopt;
  const double step = whole / std::clamp(std::ceil(4.0 * whole / length), 32.0, 400.0);
  const std::vector<Point> even = points_along(path, whole, 4 * quarter + 1);
  std::optional<Arrow> best;
  double most = -std::numeric_limits<double>::infinity(), walked = 0.0, at = step;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Point along = path[i + 1] - path[i];
    for (; at < walked + along.norm(); at += step) {
      const Point middle = path[i] + (at - walked) / along.norm() * along;
      const std::optional<Head> head = head_at(path, i, middle, length);
      if (!head) continue;
      const double share = at / whole;
      const double course = cosine(head->arrow.direction, quarters_about(even, share));
      const double merit = head->merit + 0.5 * course - 0.5 * std::abs(share - preferred_place);
      if (merit <= most) continue;
      most = merit;
      best = head->arrow;
    }
    walked += along.norm();
  }
  return best;
}

void draw_arrow(pugi::xml_node parent, std::span<const Point> points, const char* colour, double length) {
  const std::optional<Arrow> arrow = arrow_on(points, length);
  if (!arrow) return;
  const Point forward = 0.5 * length * arrow->direction;
  const Point across(-0.6 * forward.y(), 0.6 * forward.x());
  const Point back = arrow->middle - forward;
  const std::vector<Point> head = {arrow->middle + forward, back + across, back - across};
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

void draw_rings(pugi::xml_node parent, std::span<const Point> places, const Sizes& sizes, Labels& labels) {
  const double radius = ring_radius * sizes.label;
  for (const Point& place : places) {
    svg::add_circle(parent, "place", place, svg::number(radius).c_str(),
                    {{"fill", "none"}, {"stroke", noted}, {"stroke-width", svg::number(0.7 * sizes.line)}});
    std::vector<Point> ring;
    for (int i = 0; i <= 16; ++i) {
      const double angle = i * std::numbers::pi / 8.0;
      ring.push_back(place + radius * Point(std::cos(angle), std::sin(angle)));
    }
    labels.avoid(ring);
  }
}

const char* colour_of(const MatchResult& match, std::size_t path) {
  if (has_remark(match, path, {StrokeRemarkKind::order, StrokeRemarkKind::direction, StrokeRemarkKind::extra}))
    return wrong;
  if (has_remark(match, path, {StrokeRemarkKind::joined, StrokeRemarkKind::broken, StrokeRemarkKind::shape}))
    return noted;
  const bool is_misshapen = std::any_of(match.remarks.begin(), match.remarks.end(), [path](const StrokeRemark& remark) {
    return is_of_form(remark.kind) && is_about(remark, static_cast<int>(path));
  });
  return is_misshapen ? noted : svg::ink;
}

std::vector<Point> places_of_form(const MatchResult& match) {
  std::vector<Point> places;
  for (const StrokeRemark& remark : match.remarks) {
    const bool is_shape = remark.kind == StrokeRemarkKind::straight || remark.kind == StrokeRemarkKind::wavy;
    const bool is_on_all = is_shape && remark.stroke_count > 1;
    if (remark.kind <= StrokeRemarkKind::parts || is_on_all || !remark.place.allFinite()) continue;
    places.push_back(remark.place);
  }
  return places;
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
