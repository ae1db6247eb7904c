// The answer to a query on a curve, put together from what the search has at hand.
#pragma once

#include <cmath>

#include <calligraphy/collision/nearest_point.hpp>

#include "curve_derivatives.hpp"

namespace calligraphy {

/// `place`, `offset` from the query to it and `velocity` are in sizes.
inline NearestPoint curve_answer(const CurveElement& curve, double t, const Point& place, const Point& offset,
                                 const Point& velocity, NearestPointStatus status) {
  constexpr double least_speed = 1e-7;  // below it the direction of the velocity is rounding noise
  NearestPoint answer;
  const double speed = std::sqrt(velocity.squaredNorm());
  answer.parameter = t;
  answer.point = curve.origin + curve.size * place;
  answer.distance = curve.size * std::sqrt(offset.squaredNorm());
  answer.tangent = speed > least_speed ? Point(velocity / speed) : curve.tangent(t);
  answer.status = status;
  return answer;
}

template <int Degree>
inline NearestPoint curve_answer(const CurveElement& curve, double t, const Point& query, NearestPointStatus status) {
  const Point at = place<Degree>(curve.coefficients, t);
  return curve_answer(curve, t, at, at - query, first_derivative<Degree>(curve.coefficients, t), status);
}

}  // namespace calligraphy
