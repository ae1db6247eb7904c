// A curve and its derivatives in units of its size, relative to its origin; the degree is known when compiling.
#pragma once

#include <cstddef>

#include <calligraphy/collision/curve_element.hpp>

namespace calligraphy {

using Coefficients = std::array<Point, max_curve_degree>;

template <int Degree>
inline Point place(const Coefficients& c, double t) {
  Point sum = c[Degree - 1] * t;
  for (std::size_t k = Degree - 1; k-- > 0;) sum = (sum + c[k]) * t;
  return sum;
}

template <int Degree>
inline Point first_derivative(const Coefficients& c, double t) {
  Point sum = Degree * c[Degree - 1];
  for (std::size_t k = Degree - 1; k-- > 0;) sum = sum * t + static_cast<double>(k + 1) * c[k];
  return sum;
}

template <int Degree>
inline Point second_derivative(const Coefficients& c, double t) {
  Point sum = Degree * (Degree - 1) * c[Degree - 1];
  for (std::size_t k = Degree - 1; k-- > 1;) sum = sum * t + static_cast<double>((k + 1) * k) * c[k];
  return sum;
}

template <int Degree>
inline Point third_derivative(const Coefficients& c, double t) {
  if constexpr (Degree == 2) return Point::Zero();
  Point sum = Degree * (Degree - 1) * (Degree - 2) * c[Degree - 1];
  for (std::size_t k = Degree - 1; k-- > 2;) sum = sum * t + static_cast<double>((k + 1) * k * (k - 1)) * c[k];
  return sum;
}

}  // namespace calligraphy
