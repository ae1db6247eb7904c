// A curve and its derivatives in units of its size, relative to its origin; the degree is a compile-time constant.
#pragma once

#include <cstddef>

#include <calligraphy/collision/detail/curve_element.hpp>

#include "pair.hpp"

namespace calligraphy {

using detail::CurveElement;

/// The query relative to the curve's origin, in sizes.
[[gnu::always_inline]] inline Pair in_sizes(const CurveElement& curve, const Point& query) {
  return (pair(query) - pair(curve.origin)) * curve.per_size;
}

/// Evaluates pairs of terms, for a short dependency chain.
template <int Degree, typename Vector = Pair>
[[gnu::always_inline]] inline Vector place(const CurveElement& curve, double t) {
  const auto c = [&](std::size_t k) __attribute__((always_inline)) {
    return vector_of<Vector>(curve.coefficients[k - 1]);
  };
  if constexpr (Degree == 2) return (c(2) * t + c(1)) * t;
  if constexpr (Degree == 3) return (c(3) * t + c(2)) * (t * t) + c(1) * t;
  return ((c(4) * t + c(3)) * t + c(2)) * (t * t) + c(1) * t;
}

template <int Degree, typename Vector = Pair>
[[gnu::always_inline]] inline Vector first_derivative(const CurveElement& curve, double t) {
  const auto c = [&](std::size_t k) __attribute__((always_inline)) {
    return vector_of<Vector>(curve.coefficients[k - 1]) * static_cast<double>(k);
  };
  if constexpr (Degree == 2) return c(2) * t + c(1);
  if constexpr (Degree == 3) return c(3) * (t * t) + (c(2) * t + c(1));
  return (c(4) * t + c(3)) * (t * t) + (c(2) * t + c(1));
}

template <int Degree, typename Vector = Pair>
[[gnu::always_inline]] inline Vector half_second_derivative(const CurveElement& curve, double t) {
  constexpr auto factor = [](std::size_t k) { return 0.5 * static_cast<double>((k + 1) * k); };
  Vector sum = vector_of<Vector>(curve.coefficients[Degree - 1]) * factor(Degree - 1);
  for (std::size_t k = Degree - 1; k-- > 1;) sum = sum * t + vector_of<Vector>(curve.coefficients[k]) * factor(k);
  return sum;
}

}  // namespace calligraphy
