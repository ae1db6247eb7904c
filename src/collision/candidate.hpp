// A point of a curve that may be the nearest one.
#pragma once

#include <limits>

#include "curve_derivatives.hpp"

namespace calligraphy {

struct Candidate {
  double t;
  Point place, offset, velocity;  ///< in sizes; offset is from the query
  double square;                  ///< of the distance
};

template <int Degree>
inline Candidate candidate(const CurveElement& curve, const Point& query, double t) {
  Candidate at;
  at.t = t;
  at.place = place<Degree>(curve.coefficients, t);
  at.offset = at.place - query;
  at.velocity = first_derivative<Degree>(curve.coefficients, t);
  at.square = at.offset.squaredNorm();
  return at;
}

/// Whether `next` takes the place of `best`: it is nearer, or as near up to rounding and its parameter is smaller.
inline bool nearer(const Candidate& next, const Candidate& best) {
  // The difference of the squares as a product is exact to rounding however far the query is.
  const Point between = best.place - next.place, sum = best.offset + next.offset;
  const double gain = between.dot(sum);
  const double tie = 4.0 * std::numeric_limits<double>::epsilon() * between.cwiseAbs().dot(sum.cwiseAbs());
  return gain > tie || (gain >= -tie && next.t < best.t);
}

}  // namespace calligraphy
