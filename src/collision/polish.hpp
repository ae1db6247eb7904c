// From a good guess to the nearest point: one step of Halley's method, one of Newton's, and a check.
#pragma once

#include <cmath>

#include "curve_derivatives.hpp"

namespace calligraphy {

struct Polished {
  double t;
  Point place, offset, velocity;  ///< at t, in sizes; offset is from the query
  bool converged;                 ///< t is off the zero of g by less than the tolerance allows
};

/// Zero of g(t) = (B(t) - q) . B'(t) near t. The caller knows that there is one only.
template <int Degree>
inline Polished polish(const CurveElement& curve, const Point& query, double t, double tolerance) {
  const Coefficients& c = curve.coefficients;
  const double allowed = tolerance * (0.5 / Degree);  // of the parameter; the point moves faster by up to the degree
  Polished at;
  at.place = place<Degree>(c, t);
  at.offset = at.place - query;
  at.velocity = first_derivative<Degree>(c, t);
  Point acceleration = second_derivative<Degree>(c, t);
  const Point jerk = third_derivative<Degree>(c, t);
  double g = at.offset.dot(at.velocity);
  double slope = at.velocity.squaredNorm() + at.offset.dot(acceleration);
  const double bend = 3.0 * at.velocity.dot(acceleration) + at.offset.dot(jerk);
  at.t = t - 2.0 * g * slope / (2.0 * slope * slope - g * bend);

  at.place = place<Degree>(c, at.t);
  at.offset = at.place - query;
  at.velocity = first_derivative<Degree>(c, at.t);
  acceleration = second_derivative<Degree>(c, at.t);
  g = at.offset.dot(at.velocity);
  slope = at.velocity.squaredNorm() + at.offset.dot(acceleration);
  const double step = g / slope;
  if (!(std::abs(step) <= allowed)) {
    at.t -= step;
    at.place = place<Degree>(c, at.t);
    at.offset = at.place - query;
    at.velocity = first_derivative<Degree>(c, at.t);
    g = at.offset.dot(at.velocity);
  }
  at.converged = std::abs(g) <= allowed * slope && slope > curve.least_slope;
  return at;
}

}  // namespace calligraphy
