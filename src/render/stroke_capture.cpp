#include "stroke_capture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace calligraphy {
namespace {

/// Longest share of a stroke over which its direction is judged.
constexpr double max_stretch_share = 0.25;

/// A first stretch that runs more than 60 degrees off what follows, as the entry of a brush may, is not the direction
/// that a writer means: it is judged over this length [em], at most this share of the stroke.
constexpr double longer_stretch = 0.15, longer_stretch_share = 0.5, contradiction_cosine = 0.5;

/// A pen that writes another stroke was put down at most this many times as far from its start as from the due one.
constexpr double about_as_far = 1.5;

/// How badly a first stretch fits a stroke, as shares of the tolerances.
struct Misfit {
  double place, direction;
  double size() const { return std::hypot(place, direction); }
};

double misplacement(const StrokeStart& start, const Point& from, double em, const StrokeTolerances& tolerances) {
  return (from - start.point).norm() / (tolerances.start_distance * em);
}

Misfit misfit(const StrokeStart& start, const Point& from, const Point& way, double em,
              const StrokeTolerances& tolerances) {
  const double sine = start.direction.x() * way.y() - start.direction.y() * way.x();
  const double angle = std::abs(std::atan2(sine, start.direction.dot(way)));
  return {misplacement(start, from, em, tolerances), angle / tolerances.direction};
}

/// As misfit().direction <= 1, without the angle.
bool is_tolerable(const StrokeStart& start, const Point& way) {
  return start.direction.dot(way) >= start.min_cosine * way.norm();
}

/// A pen that was put down beside a stroke may approach it, by itself or led by guidance: only the rest of its way from
/// there `to` its present place shows what it writes.
Point own_way(const StrokeStart& start, const Point& from, const Point& to) {
  const Point normal(-start.direction.y(), start.direction.x());
  const double before = normal.dot(from - start.point), after = normal.dot(to - start.point);
  const double left = before >= 0.0 ? std::clamp(after, 0.0, before) : std::clamp(after, before, 0.0);
  return to - from + (before - left) * normal;
}

/// The vector from a stroke's start to the farthest of the corners within an arc length [m] and the point at that
/// length: a stroke that turns back so soon comes no nearer to its start in between.
Point first_stretch(const std::vector<StrokeElement>& elements, double arc) {
  const Point start = elements.front().origin();
  Point farthest = Point::Zero();
  for (const StrokeElement& element : elements) {
    const bool is_last = arc <= element.length();
    const Point point = element.point(is_last ? element.parameter_at(arc) : 1.0);
    if ((point - start).norm() > farthest.norm()) farthest = point - start;
    if (is_last) break;
    arc -= element.length();
  }
  return farthest;
}

}  // namespace

std::vector<StrokeStart> stroke_starts(const PlacedCharacter& placed, const StrokeTolerances& tolerances) {
  std::vector<StrokeStart> starts;
  for (const Stroke& stroke : strokes(placed.character)) {
    const std::vector<StrokeElement> elements = place_elements(stroke, placed.placement);
    double length = 0.0;
    for (const StrokeElement& element : elements) length += element.length();
    StrokeStart start;
    start.point = elements.front().origin();
    const double em = placed.placement.em;
    Point way = first_stretch(elements, std::min(tolerances.first_stretch * em, max_stretch_share * length));
    const Point longer = first_stretch(elements, std::min(longer_stretch * em, longer_stretch_share * length));
    start.bends = way.dot(longer) < contradiction_cosine * way.norm() * longer.norm();
    if (start.bends) way = longer;
    start.stretch = way.norm();
    start.direction = start.stretch > 0.0 ? Point(way / start.stretch) : elements.front().tangent(0.0);
    const bool has_direction = start.direction != Point::Zero() && tolerances.direction < std::numbers::pi;
    if (has_direction) start.min_cosine = std::cos(tolerances.direction);
    starts.push_back(start);
  }
  return starts;
}

void StrokeCapture::put_down(const Point& tip, std::span<const StrokeStart> starts, std::size_t due) noexcept {
  anchor_ = down_ = tip;
  const Point seen = tip - misplaced();
  const auto distance = [&](const StrokeStart& start) { return (seen - start.point).squaredNorm(); };
  is_nearest_ = std::all_of(starts.begin() + static_cast<std::ptrdiff_t>(due), starts.end(),
                            [&](const StrokeStart& start) { return distance(start) >= distance(starts[due]); });
  verdict_ = CaptureVerdict::undecided;
  is_first_ = true;
}

CaptureVerdict StrokeCapture::update(const Point& tip, std::span<const StrokeStart> starts, std::size_t due, double em,
                                     const StrokeTolerances& tolerances) noexcept {
  if (verdict_ == CaptureVerdict::another_stroke) return verdict_;
  const StrokeStart& start = starts[due];
  // A pen on its way back to the start, by itself or led by guidance, sets out from the nearest place that it reaches.
  const double before = start.direction.dot(anchor_ - start.point), after = start.direction.dot(tip - start.point);
  if (after < before && before > 0.0) anchor_ += (std::max(after, 0.0) - before) * start.direction;
  const Point way = own_way(start, anchor_, tip);
  // Guidance leads a pen towards the due stroke if that is the likely one, which says nothing about the others.
  const Point shown = is_nearest_ ? way : Point(tip - anchor_);
  if (!(shown.norm() >= start.stretch)) return verdict_;

  // The writer was off by about as much on the strokes before.
  const Point seen = anchor_ - misplaced();
  bool is_other = false, is_nearer = false;
  for (std::size_t later = due + 1; later < starts.size(); ++later) {
    const StrokeStart& other = starts[later];
    if (!(misplacement(other, seen, em, tolerances) <= 1.0) || !is_tolerable(other, shown)) continue;  // as most
    const Misfit expected = misfit(start, seen, shown, em, tolerances);
    const Misfit found = misfit(other, seen, shown, em, tolerances);
    if (found.size() >= expected.size() / tolerances.distinction) continue;
    is_other = true;
    is_nearer = is_nearer || found.place <= about_as_far * expected.place;
  }
  if (is_nearer && is_first_) return verdict_ = CaptureVerdict::another_stroke;
  const double moved = way.norm();
  if (!(moved >= start.stretch)) return verdict_;
  own_begin_ = tip - way;
  const bool is_near = misplacement(start, own_begin_, em, tolerances) <= 1.0;
  if (is_near && !is_other && is_tolerable(start, way)) return verdict_ = CaptureVerdict::begun;
  verdict_ = is_near ? CaptureVerdict::wrong_direction : CaptureVerdict::undecided;
  is_first_ = false;
  anchor_ = moved > 0.0 ? Point(tip - way * (start.stretch / moved)) : tip;
  return verdict_;
}

double StrokeCapture::misfit_to(const StrokeStart& start, const Point& tip, double em,
                                const StrokeTolerances& tolerances) const noexcept {
  return misfit(start, down_ - misplaced(), tip - down_, em, tolerances).size();
}

void StrokeCapture::written(const Point& start, const Point& down) noexcept {
  misplaced_ += down - start;
  ++count_;
}

}  // namespace calligraphy
