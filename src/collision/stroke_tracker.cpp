#include <calligraphy/collision/stroke_tracker.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>

#include "base/require.hpp"
#include "certified_nearest_point.hpp"
#include "length.hpp"
#include "several_elements.hpp"

namespace calligraphy {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

StrokeTracker::StrokeTracker(std::span<const StrokeElement> elements, double tolerance)
    : elements_(elements),
      tolerance_(tolerance),
      clearance_(elements_.size() > 1 ? 0.0 : infinity) {
  validate({.method = NearestPointMethod::tracked, .tolerance = tolerance});
  require(elements.size() <= max_elements_per_stroke, "number of elements", static_cast<double>(elements.size()), "",
          "at most 5");
}

[[gnu::always_inline]] inline NearestPoint StrokeTracker::find_on(int element, const Point& query) noexcept {
  const auto i = static_cast<std::size_t>(element);
  const CurveElement* const curve = elements_[i].curve();
  Track& track = tracks_[i];
  const NearestPoint closest =
      curve ? tracked_nearest_point(*curve, query, tolerance_, {}, track.parameter + track.step)
            : nearest_point(elements_[i], query);
  if (closest.status != NearestPointStatus::not_finite) {
    track.step = closest.parameter - track.parameter;
    track.parameter = closest.parameter;
  }
  return closest;
}

void StrokeTracker::keep(int element, const Point& query, double distance) noexcept {
  const auto i = static_cast<std::size_t>(element);
  tracks_[i].query = query;
  const bool is_known = distance < infinity;
  tracks_[i].clearance = is_known ? distance - distance_rounding * (distance + elements_[i].size()) : 0.0;
}

double StrokeTracker::clearance_of(int element, const Point& query) const noexcept {
  const Track& track = tracks_[static_cast<std::size_t>(element)];
  return track.clearance - length(query - track.query);
}

StrokePoint StrokeTracker::update(const Point& query) noexcept {
  StrokePoint nearest{last_, elements_.empty() ? no_point() : find_on(last_, query)};
  // The distance to an element changes by at most the distance that the pen travels.
  const double lead = clearance_ - nearest.closest.distance;
  if (lead > min_square_root && (query - last_query_).squaredNorm() < lead * lead) return nearest;
  if (query.allFinite() && !elements_.empty()) compare(query, nearest);
  return nearest;
}

[[gnu::noinline]] void StrokeTracker::compare(const Point& query, StrokePoint& nearest) noexcept {
  const auto count = static_cast<int>(elements_.size());
  double size = 0.0;
  for (const StrokeElement& element : elements_) size = std::max(size, element.size());
  keep(last_, query, nearest.closest.distance);
  double clearances[max_elements_per_stroke];
  for (int i = 0; i < count; ++i) {
    clearances[i] = clearance_of(i, query);
    if (i == last_ || clearances[i] > nearest.closest.distance) continue;
    const NearestPoint closest = find_on(i, query);
    keep(i, query, closest.distance);
    clearances[i] = clearance_of(i, query);
    if (closest.status == NearestPointStatus::not_finite) continue;
    const double gain = nearest.closest.distance - closest.distance;
    const double tie = distance_tie(size, closest.distance);
    if (gain > tie || (gain >= -tie && i < nearest.element)) nearest = {i, closest};
  }
  last_ = nearest.element;
  clearances[last_] = infinity;
  clearance_ = *std::min_element(clearances, clearances + count);
  last_query_ = query;
}

}  // namespace calligraphy
