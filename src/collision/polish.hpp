// Refines a good initial value to the nearest point: a step of fourth order, one of Newton's, and a check of both.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "candidate.hpp"

namespace calligraphy {

/// g(t) = (B(t) - q) . B'(t), half the slope of the squared distance, in powers of t. Fast to evaluate; a step on the
/// curve itself restores what cancellation loses.
template <int Degree>
struct SlopePolynomial {
  static constexpr std::size_t terms = 2 * Degree;

  template <typename Vector>
  [[gnu::always_inline]] SlopePolynomial(const CurveElement& curve, Vector query) : high_(curve.slope_of_square) {
    for (std::size_t k = 0; k < Degree; ++k) {
      low_[k] = high_[k] - static_cast<double>(k + 1) * dot(query, vector_of<Vector>(curve.coefficients[k]));
    }
  }

  struct Value {
    double g, slope, bend, sixth_twist;  ///< g, g', g'', g''' / 6
  };

  [[gnu::always_inline]] Value at(double t) const {
    const double square = t * t;
    Value value{c(last - 1) + c(last) * t, slope(t, square), 0.0, 0.0};
    for (std::size_t k = last - 1; k >= 2; k -= 2) value.g = value.g * square + (c(k - 2) + c(k - 1) * t);
    value.bend = second(last - 1) + second(last) * t;
    for (std::size_t k = last - 2; k >= 3; k -= 2) {
      value.bend = value.bend * square + (second(k - 1) + second(k) * t);
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

  /// Coefficient of t^k; the query changes only the lower ones.
  [[gnu::always_inline]] double c(std::size_t k) const { return k < Degree ? low_[k] : high_[k]; }

  [[gnu::always_inline]] double second(std::size_t k) const { return static_cast<double>(k * (k - 1)) * c(k); }

  [[gnu::always_inline]] double sixth_third(std::size_t k) const {
    return static_cast<double>(k * (k - 1) * (k - 2) / 6) * c(k);
  }

  /// Evaluated by Estrin's scheme, like the others: pairs of terms in parallel, for short dependency chains.
  [[gnu::always_inline]] double slope(double t, double square) const {
    double sum = static_cast<double>(last) * c(last);
    for (std::size_t k = last - 1; k >= 2; k -= 2) {
      sum = sum * square + (static_cast<double>(k - 1) * c(k - 1) + static_cast<double>(k) * c(k) * t);
    }
    return sum;
  }

  std::array<double, Degree> low_;
  const std::array<double, 2 * max_curve_degree>& high_;
};

/// Bounds the error of a polished parameter relative to the zero of g, which decides whether to trust it.
struct Residue {
  double step;   ///< the last one
  double slope;  ///< of g
  double bend;   ///< g''

  /// The last step is so small that two terms of the Taylor series of the curve give the new position up to rounding.
  static constexpr double max_step = 1e-5;

  [[gnu::always_inline]] bool converged(const CurveElement& curve, double allowed) const {
    return std::abs(step) <= max_step && slope > curve.min_slope &&
           step * step * std::abs(bend) <= 2.0 * allowed * slope;
  }

  /// The same for a loop that vectorises; a single query is faster with branches, which a processor predicts.
  [[gnu::always_inline]] bool converged_without_branches(const CurveElement& curve, double allowed) const {
    const bool small = std::abs(step) <= max_step, steep = slope > curve.min_slope;
    const bool accurate = step * step * std::abs(bend) <= 2.0 * allowed * slope;
    return small & steep & accurate;
  }
};

/// Error of the parameter that the tolerance permits; the point moves faster than the parameter by a factor of up to
/// the degree.
template <int Degree>
[[gnu::always_inline]] inline double allowed_error(double tolerance) {
  return tolerance * (0.5 / Degree);
}

/// A step of Householder's third method, of fourth order, towards the zero of g near t.
template <int Degree>
[[gnu::always_inline]] inline double approach(const SlopePolynomial<Degree>& polynomial, double t, double& bend) {
  const auto value = polynomial.at(t);
  const double slope_square = value.slope * value.slope, turned = value.g * value.bend;
  bend = value.bend;
  return t - value.g * (slope_square - 0.5 * turned) /
                 (value.slope * (slope_square - turned) + value.g * value.g * value.sixth_twist);
}

/// A step of Newton's method on the curve itself; `bend` is that of `approach`.
template <int Degree, typename Vector>
[[gnu::always_inline]] inline CurvePoint<Vector> settle(const CurveElement& curve,
                                                        const SlopePolynomial<Degree>& polynomial, Vector query,
                                                        double t, double bend, Residue& residue) {
  CurvePoint<Vector> at = candidate<Degree>(curve, query, t);
  const Vector half_acceleration = half_second_derivative<Degree, Vector>(curve, t);
  const double slope = polynomial.slope(t);
  const double step = dot(at.offset, at.velocity) * (1.0 / slope);
  const Vector moved = (at.velocity - half_acceleration * step) * step;
  at.t = at.t - step;
  at.place = at.place - moved;
  at.offset = at.offset - moved;
  at.velocity = at.velocity - (half_acceleration + half_acceleration) * step;
  residue = {step, slope, bend};
  return at;
}

/// Zero of g near t. The caller knows that there is only one, and checks for convergence.
template <int Degree>
[[gnu::always_inline]] inline Candidate polish(const CurveElement& curve, const SlopePolynomial<Degree>& polynomial,
                                               Pair query, double t, Residue& residue) {
  double bend;
  t = approach<Degree>(polynomial, t, bend);
  return settle<Degree>(curve, polynomial, query, t, bend, residue);
}

}  // namespace calligraphy
