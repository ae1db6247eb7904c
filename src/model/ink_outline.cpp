#include <calligraphy/model/ink_outline.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>

#include <calligraphy/base/error.hpp>
#include <calligraphy/model/stroke_polyline.hpp>

#include "base/require.hpp"
#include "stroke_ends.hpp"

namespace calligraphy {
namespace {

// The knots of each piece between corners.
constexpr std::size_t knots_within_first = 2, knots_within_other = 1;  // between those near its ends
constexpr std::size_t knots_within_hook = 2;                           // in all

Point direction(const Point& from, const Point& to) {
  const double length = (to - from).norm();
  return length > 0.0 ? Point((to - from) / length) : Point(1.0, 0.0);
}

Point left_of(const Point& direction) { return {-direction.y(), direction.x()}; }

/// A polyline parameterised by arc length. Efficient if the arc does not decrease by much from one call to the next.
class ArcLength {
 public:
  explicit ArcLength(std::vector<Point> points) : points_(std::move(points)), arcs_(points_.size(), 0.0) {
    for (std::size_t i = 1; i < points_.size(); ++i) arcs_[i] = arcs_[i - 1] + (points_[i] - points_[i - 1]).norm();
  }

  double length() const { return arcs_.back(); }

  Point at(double arc) {
    while (next_ + 1 < points_.size() && arcs_[next_] < arc) ++next_;
    while (next_ > 1 && arcs_[next_ - 1] > arc) --next_;
    const double piece = arcs_[next_] - arcs_[next_ - 1];
    const double share = piece > 0.0 ? std::clamp((arc - arcs_[next_ - 1]) / piece, 0.0, 1.0) : 0.0;
    return points_[next_ - 1] + share * (points_[next_] - points_[next_ - 1]);
  }

 private:
  std::vector<Point> points_;
  std::vector<double> arcs_;
  std::size_t next_ = 1;  ///< end of the last piece used
};

/// The path without repeated points, extended straight at both ends.
std::vector<Point> drawn_out(std::span<const Point> path, const StrokeInk& ink) {
  std::vector<Point> points{path.front()};
  for (const Point& point : path) {
    if (point != points.back()) points.push_back(point);
  }
  const std::size_t last = points.size() - 1;
  const Point start = points[0] - ink.start * direction(points[0], points[std::min<std::size_t>(1, last)]);
  const Point end = points[last] + ink.end * direction(points[last > 0 ? last - 1 : 0], points[last]);
  points.insert(points.begin(), start);
  points.push_back(end);
  return points;
}

/// Arc lengths of the corners along the path.
std::vector<double> corners_of(const Stroke& stroke) {
  std::vector<double> arcs;
  Stroke part = stroke;
  std::size_t points = 1;
  for (std::size_t i = 0; i + 1 < stroke.elements.size(); ++i) {
    const bool is_line = stroke.elements[i] == static_cast<char>(ElementKind::line);
    points += is_line ? 1 : static_cast<std::size_t>(stroke.curve_degree);
    if (is_smooth_joint(*stroke.type, stroke.elements, i)) continue;
    part.elements = stroke.elements.substr(0, i + 1);
    part.control_points = stroke.control_points.first(points);
    double arc = 0.0;
    const std::vector<Point> path = stroke_polyline(part);
    for (std::size_t k = 1; k < path.size(); ++k) arc += (path[k] - path[k - 1]).norm();
    arcs.push_back(arc);
  }
  return arcs;
}

/// Appends `count` knots evenly between the last one and `to`.
void append_between(std::vector<double>& knots, double to, std::size_t count) {
  const double step = (to - knots.back()) / static_cast<double>(count + 1);
  for (std::size_t i = 0; i < count; ++i) knots.push_back(knots.back() + step);
}

/// Places the knots along the extended path.
void place_knots(const Stroke& stroke, double length, InkLine& line) {
  constexpr double near_start = 0.035, after_start = 0.08, beside_corner = 0.035;  // [em]
  const bool is_na = ends_in_na(*stroke.type);
  const double near_end = is_na ? 0.075 : 0.045, before_end = is_na ? 0.15 : 0.1;  // [em]
  const double most = is_na ? 1.5 / 7.0 : 1.0 / 7.0;  // [1] of a piece, between two knots at its end
  std::vector<double> ends = corners_of(stroke);      // of the pieces
  for (double& end : ends) end += stroke.ink->start;
  ends.push_back(length);
  std::vector<double>& knots = line.knots;
  knots.push_back(0.0);
  for (std::size_t piece = 0; piece < ends.size(); ++piece) {
    const bool is_first = piece == 0, is_last = piece + 1 == ends.size();
    const double from = knots.back(), to = ends[piece], own = to - from;
    if (is_last && !is_first && ends_in_hook(*stroke.type)) {
      append_between(knots, to, knots_within_hook);
    } else {
      const double beside = std::min(beside_corner, own / 5.0);
      if (is_first) knots.push_back(from + std::min(near_start, own / 7.0));
      knots.push_back(from + (is_first ? std::min(after_start, own / 3.5) : beside));
      const double inner_end = to - (is_last ? std::min(before_end, 2.0 * most * own) : beside);
      append_between(knots, inner_end, is_first ? knots_within_first : knots_within_other);
      knots.push_back(inner_end);
      if (is_last) knots.push_back(to - std::min(near_end, most * own));
    }
    knots.push_back(to);
    if (!is_last) line.corners.push_back(knots.size() - 1);
  }
}

/// Appends a disc, after others that fill the gap where shifts differ much between knots that are close together.
void append_disc(const InkDisc& disc, double spacing, std::vector<InkDisc>& discs) {
  constexpr double widest = 2.5, most = 100.0;  // [spacing], steps
  const InkDisc last = discs.empty() ? disc : discs.back();
  const double gap = (disc.centre - last.centre).norm() / spacing;
  const int steps = gap > widest ? static_cast<int>(std::min(std::ceil(gap), most)) : 1;
  for (int i = 1; i < steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    discs.push_back({last.centre + share * (disc.centre - last.centre),
                     last.radius + share * (disc.radius - last.radius)});
  }
  discs.push_back(disc);
}

/// Collects the outline of discs: the points that no disc covers.
class Envelope {
 public:
  Envelope(std::span<const InkDisc> discs, double tolerance) : discs_(discs), tolerance_(tolerance) {
    for (std::size_t i = 1; i < discs.size(); ++i) {
      const double step = (discs[i].centre - discs[i - 1].centre).norm();
      largest_step_ = std::max(largest_step_, step + std::abs(discs[i].radius - discs[i - 1].radius));
    }
  }

  /// Runs along the right side of the discs, round the last, back along the left side and round the first.
  std::vector<Point> outline() {
    const std::size_t count = discs_.size();
    if (count == 1) {
      arc(discs_[0], 0.0, 2.0 * std::numbers::pi);
      return std::move(points_);
    }
    for (std::size_t i = 0; i + 1 < count; ++i) add_junction(i > 0 ? i - 1 : i + 1, i, i + 1);
    for (std::size_t i = count - 1; i > 0; --i) add_junction(i + 1 < count ? i + 1 : i - 1, i, i - 1);
    return_from_far_runs();
    return thinned();
  }

 private:
  /// Growth of the radius per distance from one disc to another, limited to 1, where one contains the other.
  double slope(std::size_t from, std::size_t to) const {
    const double distance = (discs_[to].centre - discs_[from].centre).norm();
    const double growth = discs_[to].radius - discs_[from].radius;
    if (distance <= std::abs(growth)) return growth > 0.0 ? 1.0 : growth < 0.0 ? -1.0 : 0.0;
    return growth / distance;
  }

  double heading(std::size_t from, std::size_t to) const {
    const Point along = discs_[to].centre - discs_[from].centre;
    return std::atan2(along.y(), along.x());
  }

  /// Adds the part of the outline on the right side of a disc, between its tangents with the discs before and ahead: an
  /// arc where the outline turns left, otherwise one point, since the tangents cross. At the first and the last disc,
  /// where the outline turns back, both neighbours are the same disc.
  void add_junction(std::size_t before, std::size_t at, std::size_t ahead) {
    constexpr double right = -0.5 * std::numbers::pi;
    const double tilt = std::asin(slope(at, ahead));
    const double angle = heading(at, ahead) + right - tilt;
    double turn = std::asin(slope(before, at)) - tilt;
    turn += before == ahead ? std::numbers::pi
                            : std::remainder(heading(at, ahead) - heading(before, at), 2.0 * std::numbers::pi);
    if (turn > 0.0) {
      arc(discs_[at], angle - turn, turn);
    } else {
      add(discs_[at], angle - 0.5 * turn);
    }
  }

  void arc(const InkDisc& disc, double from, double turn) {
    const double share = std::clamp(1.0 - tolerance_ / std::max(disc.radius, tolerance_), -1.0, 1.0);
    const double step = std::clamp(std::acos(share), 0.02, 1.0);
    const int pieces = static_cast<int>(std::ceil(turn / step));
    for (int i = 0; i <= pieces; ++i) add(disc, from + (pieces > 0 ? turn * i / pieces : 0.0));
  }

  void add(const InkDisc& disc, double angle) {
    const Point point = disc.centre + disc.radius * Point(std::cos(angle), std::sin(angle));
    if (is_covered(point)) {
      is_after_gap_ = true;
      return;
    }
    if (is_after_gap_) runs_.push_back(points_.size());
    is_after_gap_ = false;
    points_.push_back(point);
  }

  /// Where a side of the line pokes out of the other side, as at a corner whose legs overlap, the outline goes there
  /// and returns to where it left, so that it leaves nothing out in between.
  void return_from_far_runs() {
    for (std::size_t i = runs_.size(); i-- > 1;) {
      const std::size_t first = runs_[i - 1], next = runs_[i];
      if (first == 0) continue;
      const Point left = points_[first - 1];
      const double gap = (points_[next] - left).norm();
      if (gap >= std::min((points_[first] - left).norm(), (points_[next] - points_[next - 1]).norm())) continue;
      points_.insert(points_.begin() + static_cast<std::ptrdiff_t>(next), left);
    }
  }

  bool is_covered(const Point& point) const {
    const double within = 0.25 * tolerance_;
    for (std::size_t i = 0; i < discs_.size();) {
      const double distance = (point - discs_[i].centre).norm() - discs_[i].radius;
      if (distance < -within) return true;
      // Discs closer along the line than this cannot cover the point.
      const double clear = largest_step_ > 0.0 ? (distance + within) / largest_step_ : 0.0;
      i += std::max<std::size_t>(1, static_cast<std::size_t>(clear));
    }
    return false;
  }

  /// Drops points within the tolerance of the line between their neighbours.
  std::vector<Point> thinned() const {
    std::vector<Point> kept;
    for (std::size_t from = 0; from < points_.size();) {
      kept.push_back(points_[from]);
      std::size_t to = from + 1;
      while (to + 1 < points_.size() && is_straight(from, to + 1)) ++to;
      from = to;
    }
    return kept;
  }

  bool is_straight(std::size_t from, std::size_t to) const {
    const Point chord = points_[to] - points_[from];
    const double squared = chord.squaredNorm();
    for (std::size_t i = from + 1; i < to; ++i) {
      const Point offset = points_[i] - points_[from];
      const double share = squared > 0.0 ? std::clamp(offset.dot(chord) / squared, 0.0, 1.0) : 0.0;
      if ((offset - share * chord).squaredNorm() > tolerance_ * tolerance_) return false;
    }
    return true;
  }

  std::span<const InkDisc> discs_;
  double tolerance_;
  double largest_step_ = 0.0;  ///< most by which a point can be closer to the edge of the next disc [em]
  std::vector<Point> points_;
  std::vector<std::size_t> runs_;  ///< where points begin that follow covered ones
  bool is_after_gap_ = false;
};

}  // namespace

InkSize ink_size(const TypicalStroke& type, std::string_view elements) noexcept {
  std::size_t corners = 0;
  for (std::size_t i = 0; i + 1 < elements.size(); ++i) corners += is_smooth_joint(type, elements, i) ? 0 : 1;
  constexpr std::size_t of_first = 4 + knots_within_first;   // its start and the next two, and the one before its end
  constexpr std::size_t of_other = 3 + knots_within_other;   // its start, and the ones near both ends
  if (corners == 0) return {of_first + 2, 0};                // one near the end, and the end
  if (ends_in_hook(type)) return {of_first + of_other * (corners - 1) + knots_within_hook + 2, corners};
  return {of_first + of_other * corners + 2, corners};
}

InkLine ink_line(const Stroke& stroke, double spacing) {
  constexpr double reach = 0.02;  // [em]
  constexpr double most = 2000.0;
  if (stroke.ink == nullptr) throw ValueError("the stroke has no ink; with_typical_ink() gives it some");
  require_above_zero("spacing", spacing, "em");
  ArcLength path(drawn_out(stroke_polyline(stroke), *stroke.ink)), behind = path, ahead = path;
  const double length = path.length();
  InkLine line;
  place_knots(stroke, length, line);
  for (const double knot : line.knots) {
    line.directions.push_back(
        direction(behind.at(std::max(0.0, knot - reach)), ahead.at(std::min(length, knot + reach))));
  }
  const double step = std::max(spacing, length / most);
  for (std::size_t knot = 0; knot + 1 < line.knots.size(); ++knot) {
    const double gap = line.knots[knot + 1] - line.knots[knot];
    const int count = std::max(1, static_cast<int>(std::ceil(gap / step)));
    for (int i = knot == 0 ? 0 : 1; i <= count; ++i) {
      const double share = static_cast<double>(i) / count;
      line.points.push_back(path.at(line.knots[knot] + share * gap));
      line.places.push_back(static_cast<double>(knot) + share);
    }
  }
  return line;
}

std::vector<InkDisc> ink_discs(const Stroke& stroke, double spacing) {
  const InkLine line = ink_line(stroke, spacing);
  const StrokeInk& ink = *stroke.ink;
  std::vector<Point> shifts;
  for (std::size_t knot = 0; knot < line.knots.size(); ++knot) {
    shifts.push_back(ink.offsets[knot] * left_of(line.directions[knot]));
  }
  for (std::size_t i = 0; i < line.corners.size(); ++i) {
    shifts[line.corners[i]] += ink.shifts[i] * line.directions[line.corners[i]];
  }
  std::vector<InkDisc> discs;
  discs.reserve(line.points.size());
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const std::size_t knot = std::min(static_cast<std::size_t>(line.places[i]), line.knots.size() - 2);
    const double share = line.places[i] - static_cast<double>(knot);
    append_disc({line.points[i] + shifts[knot] + share * (shifts[knot + 1] - shifts[knot]),
                 ink.half_widths[knot] + share * (ink.half_widths[knot + 1] - ink.half_widths[knot])},
                spacing, discs);
  }
  return discs;
}

std::vector<Point> ink_outline(const Stroke& stroke, double tolerance) {
  constexpr double spacing = 0.005;  // [em]
  return ink_outline(ink_discs(stroke, spacing), tolerance);
}

std::vector<Point> ink_outline(std::span<const InkDisc> discs, double tolerance) {
  require_above_zero("tolerance", tolerance, "em");
  if (discs.empty()) throw ValueError("the outline of no discs");
  return Envelope(discs, tolerance).outline();
}

}  // namespace calligraphy
