#include <calligraphy/collision/nearest_point.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "approximate_nearest_point.hpp"
#include "base/enum_name.hpp"
#include "base/require.hpp"
#include "certified_nearest_point.hpp"
#include "length.hpp"

namespace calligraphy {

using detail::LineElement;

namespace {

/// Beyond this many lengths squares overflow.
constexpr double furthest_query = 1e100;

/// Wang 2006, sec. 4.3.1: the foot of the perpendicular, clamped to the range. Not inlined, so that nearest_point is
/// only a dispatch.
[[gnu::noinline]] NearestPoint on_line(const LineElement& line, const Point& query, const ParameterRange& range) {
  NearestPoint closest;
  closest.parameter = range.begin;
  closest.tangent = line.direction;
  const Point from_start = query - line.origin;
  const bool is_point = line.length == 0.0;
  const double furthest = is_point ? std::numeric_limits<double>::max() : furthest_query * line.length;
  if (!(std::abs(from_start.x()) <= furthest && std::abs(from_start.y()) <= furthest)) [[unlikely]] {  // true for NaN
    closest.point = line.point(range.begin);
    closest.distance = std::numeric_limits<double>::infinity();
    closest.status = NearestPointStatus::not_finite;
    return closest;
  }
  if (!is_point) closest.parameter = std::clamp(line.direction.dot(from_start) / line.length, range.begin, range.end);
  closest.point = line.point(closest.parameter);
  closest.distance = length(query - closest.point);
  closest.status = NearestPointStatus::certified;
  return closest;
}

bool usable(const ParameterRange& range) { return 0.0 <= range.begin && range.begin <= range.end && range.end <= 1.0; }

ParameterRange clamped(const ParameterRange& range) {
  const double begin = range.begin > 0.0 ? std::min(range.begin, 1.0) : 0.0;
  const double end = range.end < 1.0 ? std::max(range.end, begin) : 1.0;
  return {begin, end};
}

/// Not inlined, lest g++ unroll the recursion.
[[gnu::noinline]] NearestPoint nearest_within_clamped(const StrokeElement& element, const Point& query,
                                                      const NearestPointOptions& options, const ParameterRange& range,
                                                      double start) {
  return nearest_point(element, query, options, clamped(range), start);
}

}  // namespace

const char* to_string(NearestPointMethod method) noexcept {
  static constexpr const char* names[] = {"exact", "tracked", "sampled", "wang2006"};
  return name_of<NearestPointMethod::wang2006>(method, names, "");
}

void validate(const NearestPointOptions& options) {
  require(options.tolerance > 0.0 && options.tolerance <= 1.0, "tolerance", options.tolerance, "",
          "above 0 and at most 1");
  require_within("samples", options.samples, "", 2, 64);
  require_within("refinements", options.refinements, "", 0, 8);
}

NearestPoint nearest_point(const StrokeElement& element, const Point& query, const NearestPointOptions& options,
                           const ParameterRange& range, double start) noexcept {
  if (!usable(range)) [[unlikely]] return nearest_within_clamped(element, query, options, range, start);
  const CurveElement* const curve = element.curve();
  if (!curve) return on_line(*element.line(), query, range);
  if (options.method == NearestPointMethod::exact) {
    return certified_nearest_point(*curve, query, options.tolerance, range);
  }
  switch (options.method) {
    case NearestPointMethod::tracked:
      return tracked_nearest_point(*curve, query, options.tolerance, range, start);
    case NearestPointMethod::sampled:
      return sampled_nearest_point(*curve, query, options, range);
    default:
      return subdivided_nearest_point(*curve, query, options.tolerance, range);
  }
}

void nearest_points(const StrokeElement& element, std::span<const Point> queries, std::span<NearestPoint> results,
                    const NearestPointOptions& options) noexcept {
  const std::size_t count = std::min(queries.size(), results.size());
  queries = queries.first(count);
  results = results.first(count);
  if (element.curve() && options.method == NearestPointMethod::exact) {
    certified_nearest_points(*element.curve(), queries, results, options.tolerance);
    return;
  }
  for (std::size_t i = 0; i < count; ++i) results[i] = nearest_point(element, queries[i], options);
}

}  // namespace calligraphy
