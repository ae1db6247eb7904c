#include <calligraphy/collision/active_stroke.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace calligraphy {
namespace {

/// A pen with less than this fraction of the guidance is not writing the stroke: it may be on a stroke nearby.
constexpr double min_weight = 0.5;

/// A feature plane counts as crossed this far before it is reached [em], limited to this share of the element's length:
/// people stop short.
constexpr double plane_tolerance = 0.0375, plane_tolerance_share = 0.3;

/// The closest point is searched for within this arc length of the last one [em], so that a sharp bend, a loop or a
/// nearby part of the stroke cannot attract the pen out of order.
constexpr double window = 0.2;

/// Limit on how much earlier an offset at the start may let the pen turn a corner [em].
constexpr double max_early_turn = 0.05;

}  // namespace

void ActiveStroke::load(const Stroke& stroke, const Placement& placement) {
  em_ = placement.em;
  const std::vector<StrokeElement> elements = place_elements(stroke, placement);
  parts_.clear();
  parts_.reserve(elements.size());
  double arc = 0.0;
  for (const StrokeElement& element : elements) {
    const std::size_t i = parts_.size();
    if (i == 0) start_ = element.origin();
    const double end = arc + element.length();
    parts_.push_back({element, detail::end_plane(element), arc, end, stroke.attraction_factors[i],
                      stroke.attraction_factors[i + 1]});
    arc = end;
  }
  reload();
}

void ActiveStroke::reload() noexcept {
  active_ = 0;
  arc_ = 0.0;
  parameter_ = 0.0;
  furthest_ = 0.0;
  start_offset_ = Point::Zero();
}

void ActiveStroke::begin(const Point& tip) noexcept {
  reload();
  start_offset_ = tip - start();
}

StrokeContact ActiveStroke::nearest(const Point& tip, const StrokeOptions& options) const noexcept {
  StrokeContact contact;
  contact.closest.distance = std::numeric_limits<double>::infinity();
  for (int i = 0; i < element_count(); ++i) {
    const StrokeElement& element = part(i).element;
    const NearestPoint closest = nearest_point(element, tip, options.nearest, {}, 0.0);  // usually near the start
    if (!(closest.distance < contact.closest.distance)) continue;
    contact.element = i;
    contact.closest = closest;
    contact.weight = guidance_weight(options.space, em_, element, tip, closest, options.rules);
    contact.arc = part(i).first_arc + element.arc_length(closest.parameter);
  }
  return contact;
}

StrokePlace ActiveStroke::at(double arc) const noexcept {
  int index = 0;
  while (index + 1 < element_count() && arc > part(index).last_arc) ++index;
  const StrokeElement& element = part(index).element;
  const double t = element.parameter_at(arc - part(index).first_arc);
  return {element.point(t), element.tangent(t), element.curvature(t)};
}

void ActiveStroke::rest(const StrokeContact& nearest) noexcept {
  reload();
  active_ = nearest.element;
  arc_ = nearest.arc - part(active_).first_arc;
  parameter_ = nearest.closest.parameter;
  furthest_ = nearest.arc;
}

[[gnu::always_inline]] inline StrokeContact ActiveStroke::locate(const Point& tip,
                                                                 const StrokeOptions& options) const noexcept {
  const int index = std::min(active_, element_count() - 1);
  const Part& here = part(index);
  const StrokeElement& element = here.element;
  ParameterRange range;
  if (!is_printed(options.rules)) {
    range = {element.parameter_at(arc_ - window * em_), element.parameter_at(arc_ + window * em_)};
  }
  StrokeContact contact{index, nearest_point(element, tip, options.nearest, range, parameter_)};
  contact.weight = guidance_weight(options.space, em_, element, tip, contact.closest, options.rules);
  const double arc = element.arc_length(contact.closest.parameter);
  contact.arc = here.first_arc + arc;
  contact.attraction = here.first_attraction;
  if (!is_printed(options.rules) && here.last_attraction != here.first_attraction && element.length() > 0.0) {
    contact.attraction += (here.last_attraction - here.first_attraction) * arc / element.length();
  }
  contact.finished = is_finished();
  return contact;
}

[[gnu::always_inline]] inline bool ActiveStroke::passes(const Point& tip, const StrokeContact& contact,
                                                        const StrokeOptions& options) const noexcept {
  const Part& here = part(contact.element);
  if (is_printed(options.rules)) [[unlikely]] return here.end.signed_distance(tip) > 0.0;
  if (contact.weight < min_weight) [[unlikely]] return false;
  const double length = here.element.length();
  const double tolerance = std::min(plane_tolerance * em_, plane_tolerance_share * length);
  // The pen must also be near the feature point along the stroke: a plane crosses other parts of the same stroke too.
  // On a curve the closest point may lag behind the plane by more than the tolerance, but not by more than twice the
  // tolerance unless the pen is far away.
  const double beyond = here.last_arc - contact.arc - 2.0 * tolerance - 1e-6 * length;
  if (beyond > 0.0 && beyond * beyond > start_offset_.squaredNorm()) return false;
  // A writer who began before the start of the stroke may turn equally early before the corner.
  const double early = std::clamp(-here.end.normal.dot(start_offset_), 0.0, max_early_turn * em_);
  if (here.end.signed_distance(tip) >= -tolerance - early) return true;
  // A pen that stays on the inside of a corner never reaches the plane: it passes on the bisector, where both elements
  // attract it equally.
  if (contact.element + 1 == element_count()) return false;
  const StrokeElement& next = part(contact.element + 1).element;
  const ParameterRange range = {0.0, next.parameter_at(window * em_)};
  return nearest_point(next, tip, options.nearest, range, 0.0).distance < contact.closest.distance;
}

[[gnu::noinline]] void ActiveStroke::pass_feature(const Point& tip, const StrokeOptions& options,
                                                  StrokeContact& contact) noexcept {
  ++active_;
  if (!is_finished()) {
    arc_ = 0.0;
    parameter_ = 0.0;
    contact = locate(tip, options);
  }
  contact.passed_feature = true;
  contact.finished = is_finished();
}

StrokeContact ActiveStroke::update(const Point& tip, const StrokeOptions& options) noexcept {
  StrokeContact contact = locate(tip, options);
  if (!is_finished() && passes(tip, contact, options)) [[unlikely]] pass_feature(tip, options, contact);
  parameter_ = contact.closest.parameter;
  // A pen at or beyond the edge of the constraint space makes no progress: a stroke cannot be finished without being
  // written.
  if (contact.weight >= min_weight) {
    arc_ = contact.arc - part(contact.element).first_arc;
    furthest_ = std::max(furthest_, contact.arc);
  }
  contact.backwards = std::max(0.0, furthest_ - contact.arc);
  return contact;
}

}  // namespace calligraphy
