// Moves the edge of the ink onto the outline by least squares over points of the edge and of the outline. The target of
// each point of the edge is the outline along the normal there, that of each point of the outline outside the ink is
// the nearest disc, with the inverse of the distance as its weight: this minimises the sum of distances, the area
// between ink and outline, so that no distant corner of the outline dominates.
#include "ink_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include <calligraphy/model/ink_outline.hpp>

#include "outline.hpp"

namespace calligraphy::recognition {
namespace {

constexpr double least_half_width = 0.001;  // [em]

using Values = std::array<double, max_ink_knots>;

/// The position of a disc among the knots: past `knot`, by a share of the way to the next.
struct Place {
  int knot;
  double share;

  double interpolate(const Values& values) const {
    const auto k = static_cast<std::size_t>(knot);
    return values[k] + share * (values[k + 1] - values[k]);
  }
};

Point left_of(const Point& direction) { return {-direction.y(), direction.x()}; }

/// The line of the discs, which stays the same while the profile changes.
struct DiscLine : InkLine {
  std::vector<Place> discs;
  std::vector<int> corner_of;  ///< of each knot: the number of its corner, or -1

  int knot_count() const { return static_cast<int>(knots.size()); }
  Point sideways(std::size_t knot) const { return left_of(directions[knot]); }
  /// Index of the point nearest to a knot.
  std::size_t point_at(std::size_t knot) const {
    const auto after = std::lower_bound(places.begin(), places.end(), static_cast<double>(knot));
    return std::min(static_cast<std::size_t>(after - places.begin()), points.size() - 1);
  }
};

DiscLine line_along(Stroke stroke, double start, double end, double spacing) {
  const StrokeInk ink{start, end, {}, {}, {}};
  stroke.ink = &ink;
  DiscLine line{ink_line(stroke, spacing), {}, {}};
  for (const double place : line.places) {
    const int knot = std::min(static_cast<int>(place), line.knot_count() - 2);
    line.discs.push_back({knot, place - knot});
  }
  line.corner_of.assign(line.knots.size(), -1);
  for (std::size_t i = 0; i < line.corners.size(); ++i) line.corner_of[line.corners[i]] = static_cast<int>(i);
  return line;
}

/// The values at the knots that fit one sample at each disc best.
Values knot_values(const DiscLine& line, const std::vector<double>& samples) {
  Eigen::MatrixXd matrix = 1e-9 * Eigen::MatrixXd::Identity(line.knot_count(), line.knot_count());
  Eigen::VectorXd right = Eigen::VectorXd::Zero(line.knot_count());
  for (std::size_t i = 0; i < line.discs.size(); ++i) {
    const auto [knot, share] = line.discs[i];
    const Eigen::Vector2d weights(1.0 - share, share);
    matrix.block<2, 2>(knot, knot) += weights * weights.transpose();
    right.segment<2>(knot) += samples[i] * weights;
  }
  const Eigen::VectorXd solution = matrix.ldlt().solve(right);
  Values values{};
  std::copy(solution.begin(), solution.end(), values.begin());
  return values;
}

/// Distances along a ray to where it crosses an edge, positive ahead of `from`.
template <typename Use>
void for_crossings(const Outline& outline, const Point& from, const Point& direction, Use use) {
  for (const OutlineEdge& edge : outline.edges) {
    const Point begin = edge.from - from, end = edge.to - from;
    const double side = direction.x() * begin.y() - direction.y() * begin.x();
    const double next = direction.x() * end.y() - direction.y() * end.x();
    if ((side <= 0.0) == (next <= 0.0)) continue;
    use(direction.dot(begin) + side / (side - next) * direction.dot(end - begin), next > side, edge.is_border);
  }
}

/// The vector from a point of the line within the outline to the farthest point of the border that it sees within a
/// cone; zero if nothing is so near.
Point farthest_in_cone(const Outline& outline, const Point& from, const Point& axis) {
  constexpr double most = 0.12;  // [em]; farther than a brush presses beside the path
  constexpr double widest = 75.0 * std::numbers::pi / 180.0;
  constexpr int rays = 12;  // on each side
  Point farthest = Point::Zero();
  for (int ray = -rays; ray <= rays; ++ray) {
    const Point direction = Eigen::Rotation2Dd(widest * ray / rays) * axis;
    double seen = most;
    for_crossings(outline, from, direction, [&](double at, bool, bool is_border) {
      if (is_border && at > 0.0) seen = std::min(seen, at);
    });
    if (seen < most && seen > farthest.norm()) farthest = seen * direction;
  }
  return farthest;
}

/// Puts the discs at the corners where the outline reaches farthest outwards: there the brush pressed, and a larger
/// disc nearer to the path would cover what the outline does not.
void begin_at_feet(const DiscLine& line, const Outline& outline, StrokeInk& ink) {
  constexpr double within = 0.012, least = 0.005;  // [em]
  for (std::size_t corner = 0; corner < line.corners.size(); ++corner) {
    const std::size_t knot = line.corners[corner], at = line.point_at(knot);
    const Point& point = line.points[at];
    const Point& before = line.points[at - std::min<std::size_t>(3, at)];
    const Point& after = line.points[std::min(at + 3, line.points.size() - 1)];
    const Point outward = ((point - before).normalized() + (point - after).normalized()).normalized();
    if (!outward.allFinite() || inscribed_radius(outline, point) <= 0.0) continue;
    Point foot = farthest_in_cone(outline, point, outward);
    foot *= std::max(0.0, 1.0 - within / std::max(foot.norm(), within));
    ink.offsets[knot] = foot.dot(line.sideways(knot));
    ink.shifts[corner] = foot.dot(line.directions[knot]);
    ink.half_widths[knot] = std::max(inscribed_radius(outline, point + foot), least);
  }
}

/// The initial ink: of the discs that fit into the outline about points of the median or of the path itself.
StrokeInk first_ink(const Stroke& stroke, std::span<const Point> median, const Outline& outline, InkDetail detail,
                    bool with_feet) {
  constexpr double spacing = 0.015;  // [em]
  const BrushEnds ends = brush_ends(median, outline, half_width(median, outline));
  StrokeInk ink{ends.start, ends.end, {}, {}, {}};
  const DiscLine line = line_along(stroke, ink.start, ink.end, spacing);
  const Path on_median = resampled(median, static_cast<int>(line.points.size()), 0.0, path_length(median));
  const bool is_sideways = detail == InkDetail::full;
  std::vector<double> radii, offsets;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const auto knot = static_cast<std::size_t>(std::lround(line.places[i]));
    radii.push_back(inscribed_radius(outline, is_sideways ? on_median[i] : line.points[i]));
    offsets.push_back((on_median[i] - line.points[i]).dot(line.sideways(knot)));
  }
  ink.half_widths = knot_values(line, radii);
  for (std::size_t knot = 0; knot < line.knots.size(); ++knot) {
    ink.half_widths[knot] = std::max(ink.half_widths[knot], least_half_width);
  }
  if (!is_sideways) return ink;
  ink.offsets = knot_values(line, offsets);
  if (with_feet) begin_at_feet(line, outline, ink);
  return ink;
}

class InkFit {
 public:
  InkFit(const Stroke& stroke, const Outline& outline, const StrokeInk& first, InkDetail detail)
      : stroke_(stroke), outline_(outline), is_sideways_(detail == InkDetail::full), ink_(first) {
    const InkSize size = ink_size(*stroke.type, stroke.elements);
    knots_ = static_cast<int>(size.knots);
    corners_ = static_cast<int>(size.corners);
    lay_line();
  }

  StrokeInk run() {
    constexpr int iterations = 5;
    for (int i = 0; i < iterations; ++i) improve();
    return ink_;
  }

  /// The farthest that ink and outline were apart before the last step, and that they are now [em].
  double last_farthest() const { return farthest_; }
  double farthest() {
    compare();
    return farthest_;
  }

 private:
  // The unknowns: half-widths, offsets, shifts at corners, and how far the ends extend.
  int first_offset() const { return knots_; }
  int first_shift() const { return 2 * knots_; }
  int first_end() const { return 2 * knots_ + corners_; }
  int unknowns() const { return 2 * knots_ + corners_ + 2; }

  void improve() {
    constexpr double damping = 0.02;  // [1] of the mean weight; holds what the edge does not determine
    constexpr double most = 0.02;     // [em]
    constexpr double farthest = 0.5;  // [em]
    compare();
    matrix_.diagonal().array() += damping * matrix_.trace() / unknowns() + 1e-12;
    const Eigen::VectorXd change = matrix_.ldlt().solve(right_).cwiseMax(-most).cwiseMin(most);
    const auto move = [&](double& value, int unknown, double least) {
      value = std::clamp(value + change[unknown], least, farthest);
    };
    for (int k = 0; k < knots_; ++k) {
      move(ink_.half_widths[static_cast<std::size_t>(k)], k, least_half_width);
      if (is_sideways_) move(ink_.offsets[static_cast<std::size_t>(k)], first_offset() + k, -farthest);
    }
    for (int k = 0; k < corners_ && is_sideways_; ++k) {
      move(ink_.shifts[static_cast<std::size_t>(k)], first_shift() + k, -farthest);
    }
    move(ink_.start, first_end(), 0.0);
    move(ink_.end, first_end() + 1, 0.0);
    lay_line();
    if (is_sideways_) limit_half_widths();
  }

  void compare() {
    lay_discs();
    farthest_ = 0.0;
    matrix_.setZero(unknowns(), unknowns());
    right_.setZero(unknowns());
    for (std::size_t i = 0; i < discs_.size(); ++i) add_points(i);
    if (is_sideways_) add_uncovered();
  }

  void lay_line() {
    constexpr double spacing = 0.01;  // [em]
    line_ = line_along(stroke_, ink_.start, ink_.end, spacing);
  }

  /// Lets the discs at the knots reach beyond the outline by little: no ball on a corner that covers it.
  void limit_half_widths() {
    constexpr double most_beyond = 0.010;  // [em]
    for (std::size_t knot = 0; knot < line_.knots.size(); ++knot) {
      const double held = inscribed_radius(outline_, line_.points[line_.point_at(knot)] + shift_at(knot));
      double& half_width = ink_.half_widths[knot];
      half_width = std::min(half_width, held + most_beyond);
    }
  }

  Point shift_at(std::size_t knot) const {
    Point shift = ink_.offsets[knot] * line_.sideways(knot);
    const int corner = line_.corner_of[knot];
    if (corner >= 0) shift += ink_.shifts[static_cast<std::size_t>(corner)] * line_.directions[knot];
    return shift;
  }

  void lay_discs() {
    discs_.clear();
    largest_step_ = 1e-9;
    for (std::size_t i = 0; i < line_.points.size(); ++i) {
      const Place& place = line_.discs[i];
      const auto knot = static_cast<std::size_t>(place.knot);
      const Point shift = (1.0 - place.share) * shift_at(knot) + place.share * shift_at(knot + 1);
      discs_.push_back({line_.points[i] + shift, place.interpolate(ink_.half_widths)});
      if (i == 0) continue;
      const double step = (discs_[i].centre - discs_[i - 1].centre).norm();
      largest_step_ = std::max(largest_step_, step + std::abs(discs_[i].radius - discs_[i - 1].radius));
    }
  }

  /// Adds the points of the edge at a disc: on both sides and, at an end, around it.
  void add_points(std::size_t i) {
    constexpr double steepest = 0.95;  // growth of the radius; a disc that grows faster hides the one before
    constexpr int rays = 4;            // on each side of an end
    constexpr double widest = 1.4;     // [rad]
    const std::size_t last = discs_.size() - 1;
    const InkDisc& before = discs_[i > 0 ? i - 1 : 0];
    const InkDisc& after = discs_[std::min(last, i + 1)];
    const double distance = (after.centre - before.centre).norm();
    if (distance <= 0.0) return;
    const Point along = (after.centre - before.centre) / distance;
    const Point left = left_of(along);
    const double slope = std::clamp((after.radius - before.radius) / distance, -steepest, steepest);
    const Point across = std::sqrt(1.0 - slope * slope) * left;
    add_point(i, across - slope * along, 0.5 * distance);
    add_point(i, -across - slope * along, 0.5 * distance);
    if (i != 0 && i != last) return;
    const Point outward = i == 0 ? Point(-along) : along;
    for (int ray = -rays; ray <= rays; ++ray) {
      const double angle = widest * ray / rays;
      const Point direction = std::cos(angle) * outward + std::sin(angle) * left;
      add_point(i, direction, discs_[i].radius * widest / rays, std::cos(angle));
    }
  }

  /// Adds the point of the edge of disc i in a direction, which represents a length of the edge. As the end moves, it
  /// moves outward by `endways` times as much.
  void add_point(std::size_t i, const Point& direction, double length, double endways = 0.0) {
    // Half-widths alone cannot avoid ink outside the outline, which adds only to the union of the areas.
    const double outside = is_sideways_ ? 2.0 : 0.8;
    const Point point = discs_[i].centre + discs_[i].radius * direction;
    if (is_covered(point)) return;
    const double distance = distance_to_outline(point, direction);
    farthest_ = std::max(farthest_, -distance);
    add_row(i, direction, distance, distance < 0.0 ? outside * length : length, endways);
  }

  /// Adds the points of the outline that no disc covers.
  void add_uncovered() {
    constexpr double step = 0.012;                    // [em]
    constexpr double weight = 1.5;                    // relative to an edge of the ink within the outline
    constexpr double beyond = 0.002, most = 0.05;     // [em]; nearer points count as covered, farther ones as apart
    std::size_t nearest = 0;
    for (const OutlineEdge& edge : outline_.edges) {
      if (!edge.is_border) continue;
      const double length = (edge.to - edge.from).norm();
      const int pieces = std::max(1, static_cast<int>(std::ceil(length / step)));
      for (int i = 0; i < pieces; ++i) {
        const Point point = edge.from + (edge.to - edge.from) * (i + 0.5) / pieces;
        nearest = nearest_disc(point, nearest, beyond);
        const double distance = distance_from(nearest, point);
        farthest_ = std::max(farthest_, distance);
        if (distance < beyond || distance > most) continue;
        const Point direction = (point - discs_[nearest].centre).normalized();
        add_row(nearest, direction, distance, weight * length / pieces, endways_of(nearest, direction));
      }
    }
  }

  double distance_from(std::size_t disc, const Point& point) const {
    return (point - discs_[disc].centre).norm() - discs_[disc].radius;
  }

  /// The disc nearest to a point, or any that is less than `enough` from it: most likely one near the last one found.
  std::size_t nearest_disc(const Point& point, std::size_t last, double enough) const {
    constexpr std::size_t around = 4;
    for (std::size_t i = last - std::min(last, around); i < std::min(last + around + 1, discs_.size()); ++i) {
      if (distance_from(i, point) < enough) return i;
    }
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < discs_.size() && least >= enough; ++i) {
      const double distance = distance_from(i, point);
      if (distance >= least) continue;
      least = distance;
      nearest = i;
    }
    return nearest;
  }

  /// By how much the end disc moves in a direction as the end does; 0 for all others.
  double endways_of(std::size_t disc, const Point& direction) const {
    const std::size_t last = discs_.size() - 1;
    if ((disc != 0 && disc != last) || last == 0) return 0.0;
    const Point outward = disc == 0 ? line_.points[0] - line_.points[1] : line_.points[last] - line_.points[last - 1];
    return outward.norm() > 0.0 ? std::max(0.0, direction.dot(outward.normalized())) : 0.0;
  }

  /// Asks disc i to move its edge by a distance in a direction.
  void add_row(std::size_t i, const Point& direction, double distance, double length, double endways) {
    constexpr double nearest = 0.008;  // [em]; anything nearer counts as on the outline
    const double weight = length / std::max(std::abs(distance), nearest);
    const auto [knot, share] = line_.discs[i];
    std::array<std::pair<int, double>, 7> row{};
    std::size_t terms = 0;
    for (const auto& [at, part] : {std::pair(knot, 1.0 - share), std::pair(knot + 1, share)}) {
      row[terms++] = {at, part};
      if (!is_sideways_) continue;
      const auto k = static_cast<std::size_t>(at);
      row[terms++] = {first_offset() + at, part * direction.dot(line_.sideways(k))};
      if (line_.corner_of[k] < 0) continue;
      row[terms++] = {first_shift() + line_.corner_of[k], part * direction.dot(line_.directions[k])};
    }
    row[terms++] = {i == 0 ? first_end() : first_end() + 1, endways};
    for (const auto& [a, x] : std::span(row).first(terms)) {
      for (const auto& [b, y] : std::span(row).first(terms)) matrix_(a, b) += weight * x * y;
      right_[a] += weight * x * distance;
    }
  }

  bool is_covered(const Point& point) const {
    constexpr double within = 3e-4;  // [em]
    for (std::size_t i = 0; i < discs_.size();) {
      const double clear = distance_from(i, point);
      if (clear < -within) return true;
      // Skips discs that cannot be near enough.
      i += std::max<std::size_t>(1, static_cast<std::size_t>((clear + within) / largest_step_));
    }
    return false;
  }

  /// Distance from a point to the outline in a direction; negative, behind the point, if that is outside. At most
  /// 0.05 em.
  double distance_to_outline(const Point& point, const Point& direction) const {
    constexpr double reach = 0.05;  // [em]
    double ahead = reach, behind = -reach;
    int winding = 0;
    for_crossings(outline_, point, direction, [&](double at, bool to_the_left, bool is_border) {
      if (at > 0.0) winding += to_the_left ? 1 : -1;
      if (!is_border) return;
      if (at > 0.0) {
        ahead = std::min(ahead, at);
      } else {
        behind = std::max(behind, at);
      }
    });
    return winding != 0 ? ahead : behind;
  }

  const Stroke& stroke_;
  const Outline& outline_;
  bool is_sideways_;
  StrokeInk ink_;
  int knots_, corners_;
  DiscLine line_;
  std::vector<InkDisc> discs_;
  double farthest_ = 0.0;      ///< that ink and outline are apart [em]
  double largest_step_ = 0.0;  ///< how much nearer to a point the edge of the next disc can be [em]
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd right_;
};

}  // namespace

StrokeInk fit_ink(const Stroke& stroke, std::span<const Point> median, const Outline& outline, InkDetail detail) {
  constexpr double well = 0.02;  // [em]
  InkFit fit(stroke, outline, first_ink(stroke, median, outline, detail, true), detail);
  const StrokeInk ink = fit.run();
  if (detail != InkDetail::full || fit.last_farthest() <= well) return ink;
  // What was taken for a foot may be none: the shape is simple, or another part of the stroke is near.
  InkFit other(stroke, outline, first_ink(stroke, median, outline, detail, false), detail);
  const StrokeInk without_feet = other.run();
  return other.farthest() < fit.farthest() ? without_feet : ink;
}

}  // namespace calligraphy::recognition
