// Moves the edge of the ink onto the outline by least squares over points of the edge. The target of each point is the
// outline along the normal there, with the inverse of the distance as its weight: this minimises the sum of distances,
// the area between ink and outline, so that no distant corner of the outline dominates.
#include "ink_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include <calligraphy/model/ink_outline.hpp>

#include "outline.hpp"

namespace calligraphy::recognition {
namespace {

constexpr int knots = static_cast<int>(ink_knot_count);
constexpr double least_half_width = 0.001;  // [em]

using Values = std::array<double, ink_knot_count>;

/// The position of a disc among the knots: past `knot`, by a share of the way to the next.
struct Place {
  int knot;
  double share;

  double interpolate(const Values& values) const {
    const auto k = static_cast<std::size_t>(knot);
    return values[k] + share * (values[k + 1] - values[k]);
  }
};

/// The line of the discs without offsets, at equal steps, which stays the same while the profile changes.
struct SampledLine {
  Path points;
  Path sideways;  ///< unit vectors
  std::vector<Place> places;
};

SampledLine line_along(std::span<const Point> path, double start, double end, double spacing) {
  StrokeInk ink{start, end, {}, {}};
  const std::vector<InkDisc> centres = ink_discs(path, ink, spacing);
  ink.offsets.fill(1.0);
  const std::vector<InkDisc> shifted = ink_discs(path, ink, spacing);
  const Values at = ink_knots(start + path_length(path) + end);
  SampledLine line;
  std::size_t knot = 0;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    line.points.push_back(centres[i].centre);
    line.sideways.push_back(shifted[i].centre - centres[i].centre);
    const double share = static_cast<double>(i) / static_cast<double>(std::max<std::size_t>(1, centres.size() - 1));
    while (knot + 2 < ink_knot_count && at[knot + 1] < share) ++knot;
    line.places.push_back({static_cast<int>(knot), (share - at[knot]) / (at[knot + 1] - at[knot])});
  }
  return line;
}

/// The values at the knots that fit one sample at each place best.
Values knot_values(const std::vector<Place>& places, const std::vector<double>& samples) {
  Eigen::Matrix<double, knots, knots> matrix = 1e-9 * Eigen::Matrix<double, knots, knots>::Identity();
  Eigen::Vector<double, knots> right = Eigen::Vector<double, knots>::Zero();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto [knot, share] = places[i];
    const Eigen::Vector2d weights(1.0 - share, share);
    matrix.block<2, 2>(knot, knot) += weights * weights.transpose();
    right.segment<2>(knot) += samples[i] * weights;
  }
  const Eigen::Vector<double, knots> solution = matrix.ldlt().solve(right);
  Values values;
  std::copy(solution.begin(), solution.end(), values.begin());
  return values;
}

/// The initial ink: of the discs that fit into the outline about points of the median or of the path itself.
StrokeInk first_ink(std::span<const Point> path, std::span<const Point> median, const Outline& outline,
                    InkDetail detail) {
  constexpr double spacing = 0.015;  // [em]
  const BrushEnds ends = brush_ends(median, outline, half_width(median, outline));
  StrokeInk ink{ends.start, ends.end, {}, {}};
  const SampledLine line = line_along(path, ink.start, ink.end, spacing);
  const Path on_median = resampled(median, static_cast<int>(line.points.size()), 0.0, path_length(median));
  const bool is_sideways = detail == InkDetail::full;
  std::vector<double> radii, offsets;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    radii.push_back(inscribed_radius(outline, is_sideways ? on_median[i] : line.points[i]));
    offsets.push_back((on_median[i] - line.points[i]).dot(line.sideways[i]));
  }
  ink.half_widths = knot_values(line.places, radii);
  for (double& half_width : ink.half_widths) half_width = std::max(half_width, least_half_width);
  if (is_sideways) ink.offsets = knot_values(line.places, offsets);
  return ink;
}

class InkFit {
 public:
  InkFit(std::span<const Point> path, const Outline& outline, const StrokeInk& first, InkDetail detail)
      : path_(path), outline_(outline), is_sideways_(detail == InkDetail::full), ink_(first) {}

  StrokeInk run() {
    constexpr int iterations = 5;
    for (int i = 0; i < iterations; ++i) improve();
    return ink_;
  }

 private:
  // The unknowns: half-widths, offsets, and how far the ends extend.
  static constexpr int first_offset = knots, first_end = 2 * knots, unknowns = 2 * knots + 2;

  void improve() {
    constexpr double damping = 0.02;  // [1] of the mean weight; holds what the edge does not determine
    constexpr double most = 0.02;         // [em]
    constexpr double farthest = 0.5;      // [em]
    lay_discs();
    matrix_.setZero();
    right_.setZero();
    for (std::size_t i = 0; i < discs_.size(); ++i) add_points(i);
    matrix_.diagonal().array() += damping * matrix_.trace() / unknowns + 1e-12;
    const Eigen::Vector<double, unknowns> change = matrix_.ldlt().solve(right_).cwiseMax(-most).cwiseMin(most);
    const auto move = [&](double& value, int unknown, double least) {
      value = std::clamp(value + change[unknown], least, farthest);
    };
    for (int k = 0; k < knots; ++k) {
      move(ink_.half_widths[static_cast<std::size_t>(k)], k, least_half_width);
      if (is_sideways_) move(ink_.offsets[static_cast<std::size_t>(k)], first_offset + k, -farthest);
    }
    move(ink_.start, first_end, 0.0);
    move(ink_.end, first_end + 1, 0.0);
  }

  void lay_discs() {
    constexpr double spacing = 0.008;  // [em]
    line_ = line_along(path_, ink_.start, ink_.end, spacing);
    discs_.clear();
    largest_step_ = 1e-9;
    for (std::size_t i = 0; i < line_.points.size(); ++i) {
      const Place& place = line_.places[i];
      const Point centre = line_.points[i] + place.interpolate(ink_.offsets) * line_.sideways[i];
      discs_.push_back({centre, place.interpolate(ink_.half_widths)});
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
    const Point left(-along.y(), along.x());
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
    constexpr double nearest = 0.008;  // [em]; anything nearer counts as on the outline
    constexpr double outside = 0.8;    // weight of ink outside the outline: less, as it only adds to the union
    const Point point = discs_[i].centre + discs_[i].radius * direction;
    if (is_covered(point)) return;
    const double distance = distance_to_outline(point, direction);
    const double weight = length / std::max(std::abs(distance), nearest) * (distance < 0.0 ? outside : 1.0);
    const auto [knot, share] = line_.places[i];
    const double across = is_sideways_ ? direction.dot(line_.sideways[i]) : 0.0;
    const std::array<std::pair<int, double>, 5> row{{{knot, 1.0 - share},
                                                     {knot + 1, share},
                                                     {first_offset + knot, (1.0 - share) * across},
                                                     {first_offset + knot + 1, share * across},
                                                     {i == 0 ? first_end : first_end + 1, endways}}};
    for (const auto& [a, x] : row) {
      for (const auto& [b, y] : row) matrix_(a, b) += weight * x * y;
      right_[a] += weight * x * distance;
    }
  }

  bool is_covered(const Point& point) const {
    constexpr double within = 3e-4;  // [em]
    for (std::size_t i = 0; i < discs_.size();) {
      const double clear = (point - discs_[i].centre).norm() - discs_[i].radius;
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
    for (const OutlineEdge& edge : outline_.edges) {
      const Point from = edge.from - point, to = edge.to - point;
      const double side = direction.x() * from.y() - direction.y() * from.x();
      const double next = direction.x() * to.y() - direction.y() * to.x();
      if ((side <= 0.0) == (next <= 0.0)) continue;
      const double at = direction.dot(from) + side / (side - next) * direction.dot(to - from);
      if (at > 0.0) winding += next > side ? 1 : -1;
      if (!edge.is_border) continue;
      if (at > 0.0) {
        ahead = std::min(ahead, at);
      } else {
        behind = std::max(behind, at);
      }
    }
    return winding != 0 ? ahead : behind;
  }

  std::span<const Point> path_;
  const Outline& outline_;
  bool is_sideways_;
  StrokeInk ink_;
  SampledLine line_;
  std::vector<InkDisc> discs_;
  double largest_step_ = 0.0;  ///< how much nearer to a point the edge of the next disc can be [em]
  Eigen::Matrix<double, unknowns, unknowns> matrix_;
  Eigen::Vector<double, unknowns> right_;
};

}  // namespace

StrokeInk fit_ink(std::span<const Point> path, std::span<const Point> median, const Outline& outline,
                  InkDetail detail) {
  return InkFit(path, outline, first_ink(path, median, outline, detail), detail).run();
}

}  // namespace calligraphy::recognition
