#include <calligraphy/collision/stroke_tracker.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>

namespace calligraphy {
namespace {

/// Rounding error of a distance, relative to it and to the size of the element.
constexpr double rounding = 1e-14;
constexpr double relative_rounding = std::numeric_limits<double>::epsilon();

NearestPoint no_point() {
  NearestPoint nowhere;
  nowhere.distance = std::numeric_limits<double>::infinity();
  nowhere.status = NearestPointStatus::not_finite;
  return nowhere;
}

}  // namespace

StrokeTracker::StrokeTracker(std::span<const StrokeElement> elements, double tolerance)
    : elements_(elements.first(std::min(elements.size(), std::size_t{max_elements_per_stroke}))) {
  options_.method = NearestPointMethod::tracked;
  options_.tolerance = tolerance;
  validate(options_);
}

NearestPoint StrokeTracker::find_on(int element, const Point& query) noexcept {
  const auto i = static_cast<std::size_t>(element);
  LastQuery& last = last_queries_[i];
  const NearestPoint closest = nearest_point(elements_[i], query, options_, {}, last.parameter + last.step);
  if (closest.status == NearestPointStatus::not_finite) return closest;
  last.clearance = closest.distance - rounding * (closest.distance + elements_[i].size());
  last.query = query;
  last.step = closest.parameter - last.parameter;
  last.parameter = closest.parameter;
  return closest;
}

StrokePoint StrokeTracker::update(const Point& query) noexcept {
  if (elements_.empty()) return {0, no_point()};
  StrokePoint nearest{last_, find_on(last_, query)};
  if (nearest.closest.status == NearestPointStatus::not_finite) return nearest;
  for (int i = 0; i < static_cast<int>(elements_.size()); ++i) {
    if (i == last_) continue;
    // The distance to an element changes by at most the distance that the pen travels.
    const LastQuery& last = last_queries_[static_cast<std::size_t>(i)];
    const double lead = last.clearance - nearest.closest.distance;
    if (lead > 0.0 && (query - last.query).squaredNorm() < lead * lead) continue;
    const NearestPoint closest = find_on(i, query);
    const double gain = nearest.closest.distance - closest.distance;
    const double tie =
        rounding * elements_[static_cast<std::size_t>(i)].size() + 2.0 * relative_rounding * closest.distance;
    if (gain > tie || (gain >= -tie && i < nearest.element)) nearest = {i, closest};
  }
  last_ = nearest.element;
  return nearest;
}

}  // namespace calligraphy
