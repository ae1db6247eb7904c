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

namespace calligraphy {
namespace {

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

/// A place between two knots of the profile.
struct ProfilePlace {
  std::size_t knot;
  double share;  ///< fraction of the way from the knot to the next

  double of(const std::array<double, ink_knot_count>& values) const {
    return values[knot] + share * (values[knot + 1] - values[knot]);
  }
};

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
    if (!is_covered(point)) points_.push_back(point);
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
};

}  // namespace

std::array<double, ink_knot_count> ink_knots(double length) noexcept {
  const double near = length > 0.245 ? 0.035 / length : 1.0 / 7.0;
  const double far = length > 0.28 ? 0.08 / length : 2.0 / 7.0;
  const double third = (1.0 - 2.0 * far) / 3.0;
  return {0.0, near, far, far + third, far + 2.0 * third, 1.0 - far, 1.0 - near, 1.0};
}

std::vector<InkDisc> ink_discs(std::span<const Point> path, const StrokeInk& ink, double spacing) {
  constexpr double reach = 0.02;  // [em]
  constexpr double most = 2000.0;
  if (path.empty()) throw ValueError("ink along a path without points");
  require_above_zero("spacing", spacing, "em");
  ArcLength line(drawn_out(path, ink)), behind = line, ahead = line;
  const double length = line.length();
  const auto count = static_cast<std::size_t>(std::min(std::ceil(length / spacing), most - 1.0)) + 1;
  const std::array<double, ink_knot_count> knots = ink_knots(length);
  std::vector<InkDisc> discs;
  discs.reserve(count);
  ProfilePlace place{0, 0.0};
  for (std::size_t i = 0; i < count; ++i) {
    const double share = count > 1 ? static_cast<double>(i) / static_cast<double>(count - 1) : 0.0;
    while (place.knot + 2 < knots.size() && knots[place.knot + 1] < share) ++place.knot;
    place.share = (share - knots[place.knot]) / (knots[place.knot + 1] - knots[place.knot]);
    const double arc = share * length;
    const Point along = direction(behind.at(std::max(0.0, arc - reach)), ahead.at(std::min(length, arc + reach)));
    discs.push_back({line.at(arc) + place.of(ink.offsets) * left_of(along), place.of(ink.half_widths)});
  }
  return discs;
}

std::vector<Point> ink_outline(std::span<const Point> path, const StrokeInk& ink, double tolerance) {
  constexpr double spacing = 0.005;  // [em]
  return ink_outline(ink_discs(path, ink, spacing), tolerance);
}

std::vector<Point> ink_outline(std::span<const InkDisc> discs, double tolerance) {
  require_above_zero("tolerance", tolerance, "em");
  if (discs.empty()) throw ValueError("the outline of no discs");
  return Envelope(discs, tolerance).outline();
}

std::vector<Point> ink_outline(const Stroke& stroke, double tolerance) {
  if (stroke.ink == nullptr) throw ValueError("the stroke has no ink; with_typical_ink() gives it some");
  return ink_outline(stroke_polyline(stroke), *stroke.ink, tolerance);
}

}  // namespace calligraphy
