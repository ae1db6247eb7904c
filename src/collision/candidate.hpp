// A point of a curve that may be the nearest one.
#pragma once

#include <cmath>

#include <calligraphy/collision/nearest_point.hpp>

#include "curve_derivatives.hpp"

namespace calligraphy {

template <typename Vector>
struct CurvePoint {
  double t;
  Vector place, offset, velocity;  ///< at t, in sizes; offset is from the query
};

using Candidate = CurvePoint<Pair>;

template <int Degree, typename Vector>
[[gnu::always_inline]] inline CurvePoint<Vector> candidate(const CurveElement& curve, Vector query, double t) {
  const Vector at = place<Degree, Vector>(curve, t);
  return {t, at, at - query, first_derivative<Degree, Vector>(curve, t)};
}

/// Below this the direction of the velocity is rounding noise [sizes].
inline constexpr double min_speed = 1e-7;

/// Whether `next` replaces `best`: it is nearer, or equally near up to rounding with a smaller parameter.
[[gnu::always_inline]] inline bool nearer(const Candidate& next, const Candidate& best) {
  // The difference of the squares as a product is exact up to rounding however far the query is; the positions are
  // exact to about 1e-15 sizes.
  constexpr double rounding = 1e-14;
  const Pair sum = best.offset + next.offset;
  const double gain = dot(best.place - next.place, sum);
  const double tie = rounding * (std::abs(sum[0]) + std::abs(sum[1]));
  return gain > tie || (gain >= -tie && next.t < best.t);
}

/// Where the velocity is too small to show a direction. Not inlined, so that the usual case needs no memory for a call.
[[gnu::noinline]] inline NearestPoint answer_at_rest(const CurveElement& curve, Pair point, Pair offset, double t,
                                                     NearestPointStatus status) {
  return {t, Point(point[0], point[1]), curve.size * std::sqrt(dot(offset, offset)), curve.tangent(t), status};
}

[[gnu::always_inline]] inline NearestPoint curve_answer(const CurveElement& curve, const Candidate& at,
                                                        NearestPointStatus status) {
  const double square = dot(at.velocity, at.velocity), speed = std::sqrt(square);
  const Pair point = pair(curve.origin) + at.place * curve.size;
  if (!(speed > min_speed)) [[unlikely]] return answer_at_rest(curve, point, at.offset, at.t, status);
  const Pair tangent = at.velocity * (speed * (1.0 / square));
  return {at.t, Point(point[0], point[1]), curve.size * std::sqrt(dot(at.offset, at.offset)),
          Point(tangent[0], tangent[1]), status};
}

}  // namespace calligraphy
