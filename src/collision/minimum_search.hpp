// Isolates every minimum of the distance from a query to a curve, for cases that the signs alone do not decide.
#pragma once

#include <calligraphy/collision/nearest_point.hpp>

#include "pair.hpp"

namespace calligraphy {

using detail::CurveElement;

/// `query` relative to the curve's origin and size, finite, at most 1e100.
NearestPoint search_minima(const CurveElement& curve, Pair query, double tolerance,
                           const ParameterRange& range) noexcept;

}  // namespace calligraphy
