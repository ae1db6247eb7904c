#include <calligraphy/collision/nearest_point.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>

#include <calligraphy/base/error.hpp>

#include "approximate_nearest_point.hpp"
#include "certified_nearest_point.hpp"
#include "length.hpp"

namespace calligraphy {
namespace {

/// Beyond this many lengths squares overflow.
constexpr double furthest_query = 1e100;

/// Wang 2006, sec. 4.3.1: the perpendicular foot, clamped to the range. Not inlined, so that all nearest_point does is
/// jump.
[[gnu::noinline]] NearestPoint on_line(const LineElement& line, const Point& query, const ParameterRange& range) {
  NearestPoint foot;
  foot.parameter = range.begin;
  foot.tangent = line.direction;
  const Point from_start = query - line.origin;
  const bool is_point = !(line.length > 0.0);
  if (std::isnan(line.length) || !query.allFinite() ||
      !(is_point || from_start.cwiseAbs().maxCoeff() <= furthest_query * line.length)) {
    foot.point = line.point(range.begin);
    foot.distance = std::numeric_limits<double>::infinity();
    foot.status = NearestPointStatus::not_finite;
    return foot;
  }
  if (!is_point) foot.parameter = std::clamp(line.direction.dot(from_start) / line.length, range.begin, range.end);
  foot.point = line.point(foot.parameter);
  foot.distance = length(query - foot.point);
  foot.status = NearestPointStatus::certified;
  return foot;
}

bool usable(const ParameterRange& range) { return 0.0 <= range.begin && range.begin <= range.end && range.end <= 1.0; }

ParameterRange clamped(const ParameterRange& range) {
  const double begin = range.begin > 0.0 ? std::min(range.begin, 1.0) : 0.0;
  const double end = range.end < 1.0 ? std::max(range.end, begin) : 1.0;
  return {begin, end};
}

void require(bool is_good, const char* name, double value, const char* domain) {
  if (is_good) return;
  std::ostringstream message;
  message << name << " = " << value << ": expected " << domain;
  throw ValueError(message.str());
}

}  // namespace

void validate(const NearestPointOptions& options) {
  require(options.tolerance > 0.0 && options.tolerance <= 1.0, "tolerance", options.tolerance,
          "a number above 0, at most 1");
  require(options.samples >= 2 && options.samples <= 64, "samples", options.samples, "a whole number from 2 to 64");
  require(options.refinements >= 0 && options.refinements <= 8, "refinements", options.refinements,
          "a whole number from 0 to 8");
}

NearestPoint nearest_point(const StrokeElement& element, const Point& query, const NearestPointOptions& options,
                           const ParameterRange& range, double start) noexcept {
  if (!usable(range)) return nearest_point(element, query, options, clamped(range), start);
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
