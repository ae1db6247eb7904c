// The methods without a certificate: sampling, and the subdivision of Wang 2006.
#pragma once

#include <calligraphy/collision/nearest_point.hpp>

namespace calligraphy {

using detail::CurveElement;

NearestPoint sampled_nearest_point(const CurveElement& curve, const Point& query, const NearestPointOptions& options,
                                   const ParameterRange& range) noexcept;

NearestPoint subdivided_nearest_point(const CurveElement& curve, const Point& query, double tolerance,
                                      const ParameterRange& range) noexcept;

}  // namespace calligraphy
