// Refines the last nearest point to the next one: a step of fourth order on the curve itself, and a check of what it
// leaves.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "candidate.hpp"

namespace calligraphy {

/// A larger step loses digits, and seldom leads near the zero.
inline constexpr double furthest_step = 0.1;

/// A step from t towards a zero of g, and whether that has been reached well within `allowed`, the permitted error of
/// the parameter. The caller knows that there is only one zero.
template <int Degree>
[[gnu::always_inline]] inline bool follow(const CurveElement& curve, Pair query, double t, double allowed,
                                          Candidate& found) {
  // The curve around t, by powers.
  const Pair place = calligraphy::place<Degree>(curve, t), offset = place - query;
  std::array<Pair, Degree + 1> c = {Pair{}, first_derivative<Degree>(curve, t),
                                    half_second_derivative<Degree>(curve, t)};
  if constexpr (Degree >= 3) c[3] = pair(curve.coefficients[2]);
  if constexpr (Degree == 4) {
    c[4] = pair(curve.coefficients[3]);
    c[3] += c[4] * (4.0 * t);
  }

  // g around t, by powers: k + 1 times half the coefficients of the square of the distance.
  Pair linear = c[1] * c[1] + (offset + offset) * c[2], quadratic = c[1] * c[2], cubic = c[2] * c[2];
  if constexpr (Degree >= 3) {
    quadratic += offset * c[3];
    cubic += (c[1] + c[1]) * c[3];
  }
  if constexpr (Degree == 4) cubic += (offset + offset) * c[4];
  const double g = dot(offset, c[1]), slope = sum(linear);
  const double half_bend = 3.0 * sum(quadratic), sixth_twist = 2.0 * sum(cubic);

  // Householder's third method: what it leaves is of the fourth power of the step.
  const double bent = g * half_bend, straight = slope * slope - bent;
  const double step = -(g * straight) / (slope * (straight - bent) + g * g * sixth_twist);

  // The complete Horner scheme: the movement, and the first derivative and half the second there.
  for (std::size_t derivative = 0; derivative <= 2; ++derivative) {
    for (std::size_t k = Degree; k-- > derivative;) c[k] += c[k + 1] * step;
  }
  found = {t + step, place + c[0], offset + c[0], c[1]};

  // What is left of g decides: Newton's method would take a step of about left / slope more, and certainly converges
  // if the slope changes little on the way (Kantorovich's theorem).
  constexpr double share = 0.125;  // of the permitted error: costs little, since most steps leave far less
  const double left = dot(found.offset, c[1]);
  const double new_slope = sum(c[1] * c[1] + (found.offset + found.offset) * c[2]);
  return std::abs(step) <= furthest_step && new_slope > curve.min_slope &&
         std::abs(left) <= share * allowed * new_slope &&
         16.0 * std::abs(left * half_bend) <= new_slope * new_slope;
}

}  // namespace calligraphy
