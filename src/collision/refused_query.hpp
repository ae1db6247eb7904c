// The result for a query that is not finite, or so far from the curve that squares would overflow.
#pragma once

#include <limits>

#include <calligraphy/collision/nearest_point.hpp>

#include "pair.hpp"

namespace calligraphy {

using detail::CurveElement;

/// `query` in sizes.
inline bool within_reach(Pair query) { return within(query, 1e100); }

inline NearestPoint refused_query(const CurveElement& curve, const ParameterRange& range) {
  NearestPoint lost;
  lost.parameter = range.begin;
  lost.point = curve.point(range.begin);
  lost.distance = std::numeric_limits<double>::infinity();
  lost.tangent = curve.tangent(range.begin);
  lost.status = NearestPointStatus::not_finite;
  return lost;
}

}  // namespace calligraphy
