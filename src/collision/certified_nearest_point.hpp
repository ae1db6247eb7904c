// The global nearest point on a curve, certified by signs.
#pragma once

#include <span>

#include <calligraphy/collision/nearest_point.hpp>

namespace calligraphy {

using detail::CurveElement;

NearestPoint certified_nearest_point(const CurveElement& curve, const Point& query, double tolerance,
                                     const ParameterRange& range) noexcept;

/// Many queries at once; each result equals that of a single query to the last bit.
void certified_nearest_points(const CurveElement& curve, std::span<const Point> queries,
                              std::span<NearestPoint> results, double tolerance) noexcept;

/// The same point, searched from the last parameter.
NearestPoint tracked_nearest_point(const CurveElement& curve, const Point& query, double tolerance,
                                   const ParameterRange& range, double start) noexcept;

}  // namespace calligraphy
