// A curve and its derivatives in units of its size, relative to its origin; the degree is known when compiling.
#pragma once

#include <cstddef>

#include <calligraphy/collision/curve_element.hpp>

#include "pair.hpp"

namespace calligraphy {

/// The query relative to the curve's origin, in sizes.
[[gnu::always_inline]] inline Pair in_sizes(const CurveElement& curve, const Point& query) {
  return (pair(query) - pair(curve.origin)) * curve.per_size;
}

template <int Degree, typename Vector = Pair>
[[gnu::always_inline]] inline Vector place(const CurveElement& curve, double t) {
  Vector sum = vector_of<Vector>(curve.coefficients[Degree - 1]) * t;
  for (std::size_t k = Degree - 1; k-- > 0;) sum = (sum + vector_of<Vector>(curve.coefficients[k])) * t;
  return sum;
}

template <int Degree, typename Vector = Pair>
[[gnu::always_inline]] inline Vector first_derivative(const CurveElement& curve, double t) {
  Vector sum = vector_of<Vector>(curve.coefficients[Degree - 1]) * static_cast<double>(Degree);
  for (std::size_t k = Degree - 1; k-- > 0;) {
    sum = sum * t + vector_of<Vector>(curve.coefficients[k]) * static_cast<double>(k + 1);
  }
  return sum;
}

template <int Degree, typename Vector = Pair>
[[gnu::always_inline]] inline Vector second_derivative(const CurveElement& curve, double t) {
  Vector sum = vector_of<Vector>(curve.coefficients[Degree - 1]) * static_cast<double>(Degree * (Degree - 1));
  for (std::size_t k = Degree - 1; k-- > 1;) {
    sum = sum * t + vector_of<Vector>(curve.coefficients[k]) * static_cast<double>((k + 1) * k);
  }
  return sum;
}

}  // namespace calligraphy
