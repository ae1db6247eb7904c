#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "bitmap.hpp"
#include "import_measures.hpp"
#include "importers/fit/outline.hpp"

namespace calligraphy::recognition {
namespace {

constexpr double joined = 0.005;  // [em]; strokes that nearly touch look as if they did
constexpr double apart = 0.01;    // [em]
constexpr double box_gap = 0.03;  // [em]; strokes whose boxes are farther apart are no neighbours

bool segments_cross(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto side = [](const Point& from, const Point& to, const Point& point) {
    return (to.x() - from.x()) * (point.y() - from.y()) - (to.y() - from.y()) * (point.x() - from.x());
  };
  return (side(a, b, c) > 0.0) != (side(a, b, d) > 0.0) && (side(c, d, a) > 0.0) != (side(c, d, b) > 0.0);
}

/// 0 if the outlines overlap.
double gap_between(const Outline& one, const Outline& other) {
  const auto lies_in = [](const Outline& outline) {
    return [&](const Point& point) { return inscribed_radius(outline, point) > 0.0; };
  };
  if (std::any_of(other.starts.begin(), other.starts.end(), lies_in(one))) return 0.0;
  if (std::any_of(one.starts.begin(), one.starts.end(), lies_in(other))) return 0.0;
  double squared = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, ab_is_border] : one.edges) {
    for (const auto& [c, d, cd_is_border] : other.edges) {
      if (segments_cross(a, b, c, d)) return 0.0;
      squared = std::min(squared, (nearest_on_segment(c, a, b) - c).squaredNorm());
      squared = std::min(squared, (nearest_on_segment(a, c, d) - a).squaredNorm());
    }
  }
  return std::sqrt(squared);
}

/// Distance from the ink [em]; negative inside it.
double distance_from(std::span<const InkDisc> ink, const Point& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const InkDisc& disc : ink) least = std::min(least, (point - disc.centre).norm() - disc.radius);
  return least;
}

/// Distance from what the outline holds [em]; 0 inside.
double distance_from(const Outline& outline, const Point& point) {
  if (inscribed_radius(outline, point) > 0.0) return 0.0;
  double squared = std::numeric_limits<double>::infinity();
  for (const auto& [from, to, is_border] : outline.edges) {
    if (is_border) squared = std::min(squared, (nearest_on_segment(point, from, to) - point).squaredNorm());
  }
  return std::sqrt(squared);
}

/// The largest distance of a point of the border from a shape [em].
template <typename Shape>
double farthest(const Outline& border, const Shape& shape) {
  constexpr double step = 0.004;  // [em]
  double most = 0.0;
  for (const auto& [from, to, is_border] : border.edges) {
    if (!is_border) continue;
    const int pieces = static_cast<int>(std::ceil((to - from).norm() / step));
    for (int i = 0; i < pieces; ++i) most = std::max(most, distance_from(shape, from + (to - from) * i / pieces));
  }
  return most;
}

/// The sharpest turn of an outline into its ink near a point [degree], between chords of 0.02 em. O(edges).
double sharpest_notch(const Outline& outline, const Point& tip) {
  constexpr double step = 0.004, near = 0.1;  // [em]
  constexpr std::size_t chord = 5;            // [step]
  Path border;
  double twice_area = 0.0;
  for (const auto& [from, to, is_border] : outline.edges) {
    border.push_back(from);
    twice_area += from.x() * to.y() - from.y() * to.x();
  }
  border.push_back(border.front());
  const int count = std::max(3, static_cast<int>(path_length(border) / step));
  border = resampled(border, count + 1, 0.0, path_length(border));
  border.pop_back();
  double sharpest = 0.0;
  for (std::size_t i = 0; i < border.size(); ++i) {
    if ((border[i] - tip).norm() > near) continue;
    const Point& before = border[(i + border.size() - chord % border.size()) % border.size()];
    const Point& after = border[(i + chord) % border.size()];
    const double turn = wrapped(direction_of(after - border[i]) - direction_of(border[i] - before));
    sharpest = std::max(sharpest, twice_area > 0.0 ? -turn : turn);
  }
  return sharpest;
}

Point nearest_on_border(const Outline& outline, const Point& point) {
  Point nearest = point;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [from, to, is_border] : outline.edges) {
    const Point at = nearest_on_segment(point, from, to);
    if (!is_border || (at - point).norm() >= least) continue;
    least = (at - point).norm();
    nearest = at;
  }
  return nearest;
}

/// At most 0 if the inks overlap.
double gap_between(std::span<const InkDisc> one, std::span<const InkDisc> other) {
  double least = std::numeric_limits<double>::infinity();
  for (const InkDisc& a : one) {
    for (const InkDisc& b : other) least = std::min(least, (a.centre - b.centre).norm() - a.radius - b.radius);
  }
  return least;
}

}  // namespace

InkMeasures measure_ink(std::span<const Outline> outlines, std::span<const Point> ends,
                        std::span<const std::vector<InkDisc>> inks) {
  constexpr double tolerance = 5e-4;  // [em]
  constexpr int pixels_per_em = 512;
  Bitmap outline(pixels_per_em), ink(pixels_per_em), all_outlines(pixels_per_em), all_ink(pixels_per_em);
  InkMeasures measures;
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    outline.clear();
    outline.fill(outlines[i]);
    ink.clear();
    for (const InkDisc& disc : inks[i]) ink.fill(disc);
    measures.strokes.push_back(intersection_over_union(outline, ink));
    const Outline drawn(ink_outline(inks[i], tolerance));
    const Point tip = nearest_on_border(outlines[i], ends[i]);
    measures.uncovered.push_back(farthest(outlines[i], std::span<const InkDisc>(inks[i])));
    measures.beyond.push_back(farthest(drawn, outlines[i]));
    measures.notches.push_back(sharpest_notch(drawn, tip));
    measures.source_notches.push_back(sharpest_notch(outlines[i], tip));
    all_outlines.add(outline);
    all_ink.add(ink);
  }
  measures.characters.push_back(intersection_over_union(all_outlines, all_ink));

  std::vector<Eigen::AlignedBox2d> boxes;
  for (const Outline& each : outlines) boxes.push_back(box_of(each));
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    for (std::size_t k = i + 1; k < outlines.size(); ++k) {
      if (boxes[i].exteriorDistance(boxes[k]) > box_gap) continue;
      const double wanted = gap_between(outlines[i], outlines[k]);
      if (wanted > 0.0 && wanted <= apart) continue;
      const double drawn = gap_between(inks[i], inks[k]);
      if (wanted > 0.0) {
        ++measures.apart;
        measures.new_contacts += drawn <= 0.0 ? 1 : 0;
      } else {
        ++measures.contacts;
        measures.contacts_kept += drawn <= joined ? 1 : 0;
      }
    }
  }
  return measures;
}

}  // namespace calligraphy::recognition
