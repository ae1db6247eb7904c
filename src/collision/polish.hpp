// From a good guess to the nearest point: a step of Halley's method, one of Newton's, and a check of both.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "candidate.hpp"

namespace calligraphy {

/// g(t) = (B(t) - q) . B'(t), half the slope of the squared distance, by powers of t. Quick to evaluate; what is lost
/// to cancellation, a step on the curve itself makes good.
template <int Degree>
struct SlopePolynomial {
  static constexpr std::size_t terms = 2 * Degree;
  std::array<double, terms> c;

  [[gnu::always_inline]] SlopePolynomial(const CurveElement& curve, Pair query) {
    for (std::size_t k = 0; k < terms; ++k) {
      c[k] = curve.slope_of_square[k];
      if (k < Degree) c[k] -= static_cast<double>(k + 1) * dot(query, pair(curve.coefficients[k]));
    }
  }

  struct Value {
    double g, slope, half_bend, sixth_twist;  ///< g, g', g'' / 2, g''' / 6
  };

  [[gnu::always_inline]] Value at(double t) const {
    const double square = t * t;
    Value value{c[last - 1] + c[last] * t, slope(t, square), 0.0, 0.0};
    for (std::size_t k = last - 1; k >= 2; k -= 2) value.g = value.g * square + (c[k - 2] + c[k - 1] * t);
    value.half_bend = half_second(last - 1) + half_second(last) * t;
    for (std::size_t k = last - 2; k >= 3; k -= 2) {
      value.half_bend = value.half_bend * square + (half_second(k - 1) + half_second(k) * t);
    }
    value.sixth_twist = sixth_third(last);
    for (std::size_t k = last - 1; k >= 4; k -= 2) {
      value.sixth_twist = value.sixth_twist * square + (sixth_third(k - 1) + sixth_third(k) * t);
    }
    return value;
  }

  [[gnu::always_inline]] double slope(double t) const { return slope(t, t * t); }

 private:
  static constexpr std::size_t last = terms - 1;

  double half_second(std::size_t k) const { return static_cast<double>(k * (k - 1) / 2) * c[k]; }

  double sixth_third(std::size_t k) const { return static_cast<double>(k * (k - 1) * (k - 2) / 6) * c[k]; }

  /// Like the others by Estrin's scheme: pairs of terms side by side, for short chains of dependent operations.
  [[gnu::always_inline]] double slope(double t, double square) const {
    double sum = static_cast<double>(last) * c[last];
    for (std::size_t k = last - 1; k >= 2; k -= 2) {
      sum = sum * square + (static_cast<double>(k - 1) * c[k - 1] + static_cast<double>(k) * c[k] * t);
    }
    return sum;
  }
};

struct Polished {
  Candidate at;
  bool converged;  ///< the parameter is off the zero of g by less than the tolerance allows
};

/// Zero of g near t. The caller knows that there is one only.
template <int Degree>
[[gnu::always_inline]] inline Polished polish(const CurveElement& curve, const SlopePolynomial<Degree>& polynomial,
                                              Pair query, double t, double tolerance) {
  const auto value = polynomial.at(t);
  const double slope_square = value.slope * value.slope, turned = value.g * value.half_bend;
  t -= value.g * (slope_square - turned) /
       (value.slope * (slope_square - 2.0 * turned) + value.g * value.g * value.sixth_twist);

  Candidate at = candidate<Degree>(curve, query, t);
  const Pair acceleration = second_derivative<Degree>(curve, t);
  const double slope = polynomial.slope(t);
  const double step = dot(at.offset, at.velocity) * (1.0 / slope);
  // The step is so small that two terms of the curve's Taylor series give the new place to rounding.
  constexpr double largest_step = 1e-5;
  const Pair moved = (at.velocity - acceleration * (0.5 * step)) * step;
  at.t -= step;
  at.place -= moved;
  at.offset -= moved;
  at.velocity -= acceleration * step;
  const double allowed = tolerance * (0.5 / Degree);  // of the parameter; the point moves faster by up to the degree
  return {at, std::abs(step) <= largest_step && slope > curve.least_slope &&
                  step * step * std::abs(value.half_bend) <= allowed * slope};
}

}  // namespace calligraphy
