#include <calligraphy/collision/active_stroke.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace calligraphy {
namespace {

/// A pen with less than this fraction of the guidance is not writing the stroke: it may be on a nearby stroke.
constexpr double min_weight = 0.5;

/// Most that an offset at the start may bring a corner forward [em].
constexpr double max_early_turn = 0.05;

}  // namespace

void ActiveStroke::load(const Stroke& stroke, const Placement& placement) noexcept {
  element_count_ = static_cast<int>(stroke.elements.size());
  em_ = placement.em;
  std::array<Point, max_curve_degree + 1> points;
  std::size_t first = 0;
  for (std::size_t i = 0; i < stroke.elements.size(); ++i) {
    const bool is_line = stroke.elements[i] == static_cast<char>(ElementKind::line);
    const auto degree = static_cast<std::size_t>(is_line ? 1 : stroke.curve_degree);
    for (std::size_t k = 0; k <= degree; ++k) points[k] = placement.to_page(stroke.control_points[first + k]);
    elements_[i] = prepare_element(std::span(points.data(), degree + 1));
    planes_[i] = end_plane(elements_[i]);
    first_arc_[i + 1] = first_arc_[i] + elements_[i].length();
    first += degree;
  }
  std::copy(stroke.attraction_factors.begin(), stroke.attraction_factors.end(), attraction_.begin());
  reload();
}

void ActiveStroke::reload() noexcept {
  active_ = 0;
  arc_ = 0.0;
  parameter_ = 0.0;
  furthest_ = 0.0;
  misplaced_ = Point::Zero();
  misplacement_ = 0.0;
}

void ActiveStroke::begin(const Point& tip) noexcept {
  reload();
  misplaced_ = tip - start();
  misplacement_ = misplaced_.norm();
}

StrokeContact ActiveStroke::nearest(const Point& tip, const StrokeRules& rules) const noexcept {
  StrokeContact contact;
  contact.closest.distance = std::numeric_limits<double>::infinity();
  for (int i = 0; i < element_count_; ++i) {
    const StrokeElement& element = elements_[static_cast<std::size_t>(i)];
    const NearestPoint closest = nearest_point(element, tip, rules.nearest);
    if (!(closest.distance < contact.closest.distance)) continue;
    contact.element = i;
    contact.closest = closest;
    contact.weight = guidance_weight(rules.space, em_, element, tip, closest);
    contact.arc = first_arc_[static_cast<std::size_t>(i)] + element.arc_length(closest.parameter);
  }
  return contact;
}

void ActiveStroke::rest(const StrokeContact& nearest) noexcept {
  reload();
  active_ = nearest.element;
  arc_ = nearest.arc - first_arc_[static_cast<std::size_t>(active_)];
  parameter_ = nearest.closest.parameter;
  furthest_ = nearest.arc;
}

StrokeContact ActiveStroke::update(const Point& tip, const StrokeRules& rules) noexcept {
  StrokeContact contact = locate(tip, rules);
  if (active_ < element_count_ && passes(tip, contact, rules)) {
    ++active_;
    if (active_ < element_count_) {
      arc_ = 0.0;
      parameter_ = 0.0;
      contact = locate(tip, rules);
    }
    contact.passed_feature = true;
    contact.finished = active_ == element_count_;
  }
  parameter_ = contact.closest.parameter;
  // A pen at the edge of the constraint space or outside makes no progress: a stroke cannot be finished without being
  // written.
  if (contact.weight >= min_weight) {
    arc_ = contact.arc - first_arc_[static_cast<std::size_t>(contact.element)];
    furthest_ = std::max(furthest_, contact.arc);
  }
  contact.backwards = std::max(0.0, furthest_ - contact.arc);
  return contact;
}

StrokeContact ActiveStroke::locate(const Point& tip, const StrokeRules& rules) const noexcept {
  const int index = std::min(active_, element_count_ - 1);
  const auto i = static_cast<std::size_t>(index);
  const StrokeElement& element = elements_[i];

  ParameterRange range;
  if (rules.window > 0.0) {
    const double window = rules.window * em_;
    range = {element.parameter_at(arc_ - window), element.parameter_at(arc_ + window)};
  }
  StrokeContact contact;
  contact.element = index;
  contact.closest = nearest_point(element, tip, rules.nearest, range, parameter_);
  contact.weight = guidance_weight(rules.space, em_, element, tip, contact.closest);
  const double arc = element.arc_length(contact.closest.parameter);
  contact.arc = first_arc_[i] + arc;
  contact.attraction = attraction_[i];
  if (rules.attraction == AttractionRule::interpolated && element.length() > 0.0) {
    contact.attraction += (attraction_[i + 1] - attraction_[i]) * arc / element.length();
  }
  contact.finished = active_ == element_count_;
  return contact;
}

bool ActiveStroke::passes(const Point& tip, const StrokeContact& contact, const StrokeRules& rules) const noexcept {
  const auto i = static_cast<std::size_t>(contact.element);
  if (rules.plane == FeaturePlaneRule::wang2006) return planes_[i].signed_distance(tip) > 0.0;
  if (contact.weight < min_weight) return false;
  const double length = elements_[i].length();
  const double tolerance = std::min(rules.plane_tolerance * em_, 0.3 * length);
  const double left = first_arc_[i + 1] - contact.arc;
  // Near the feature point along the stroke too: a plane also crosses other parts of the same stroke. On a curve the
  // closest point may lag behind the plane by more than the tolerance, but not by more than twice the tolerance unless
  // the pen is far away.
  if (left > 2.0 * tolerance + misplacement_ + 1e-6 * length) return false;
  // One who began the stroke before its start may turn as much before the corner.
  const double early = std::clamp(-planes_[i].normal.dot(misplaced_), 0.0, max_early_turn * em_);
  if (planes_[i].signed_distance(tip) >= -tolerance - early) return true;
  // A pen that stays on the inside of a corner never reaches the plane: it passes on the bisector, where both elements
  // attract it equally.
  if (contact.element + 1 == element_count_) return false;
  const StrokeElement& next = elements_[i + 1];
  const ParameterRange range = {0.0, rules.window > 0.0 ? next.parameter_at(rules.window * em_) : 1.0};
  return nearest_point(next, tip, rules.nearest, range, 0.0).distance < contact.closest.distance;
}

}  // namespace calligraphy
