// Two coordinates, for the searches. Everything is inlined: a call from code for wide registers into code compiled
// without them would cost more than the query.
#pragma once

#include <cmath>
#include <cstring>
#include <type_traits>

#include <calligraphy/model/point.hpp>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace calligraphy {

/// Both coordinates in one register, for a single query.
using Pair = double __attribute__((vector_size(16)));

[[gnu::always_inline]] inline double x_of(Pair pair) { return pair[0]; }
[[gnu::always_inline]] inline double y_of(Pair pair) { return pair[1]; }

/// Separate coordinates, for many queries in a loop that the compiler vectorises.
struct Coordinates {
  double x, y;
};

[[gnu::always_inline]] inline double x_of(Coordinates c) { return c.x; }
[[gnu::always_inline]] inline double y_of(Coordinates c) { return c.y; }
[[gnu::always_inline]] inline Coordinates operator+(Coordinates a, Coordinates b) { return {a.x + b.x, a.y + b.y}; }
[[gnu::always_inline]] inline Coordinates operator-(Coordinates a, Coordinates b) { return {a.x - b.x, a.y - b.y}; }
[[gnu::always_inline]] inline Coordinates operator*(Coordinates a, Coordinates b) { return {a.x * b.x, a.y * b.y}; }
[[gnu::always_inline]] inline Coordinates operator*(Coordinates a, double b) { return {a.x * b, a.y * b}; }

template <typename Vector>
[[gnu::always_inline]] inline Vector vector_of(const Point& point) {
  if constexpr (std::is_same_v<Vector, Pair>) {
    Pair both;
    std::memcpy(&both, point.data(), sizeof both);
    return both;
  } else {
    return {point.x(), point.y()};
  }
}

[[gnu::always_inline]] inline Pair pair(const Point& point) { return vector_of<Pair>(point); }

template <typename Vector>
[[gnu::always_inline]] inline double sum(Vector v) {
#if defined(__SSE2__)
  // Spares a copy that g++ makes of the first coordinate.
  if constexpr (std::is_same_v<Vector, Pair>) return _mm_cvtsd_f64(_mm_add_sd(v, _mm_unpackhi_pd(v, v)));
#endif
  return x_of(v) + y_of(v);
}

template <typename Vector>
[[gnu::always_inline]] inline double dot(Vector a, Vector b) {
  return sum(a * b);
}

[[gnu::always_inline]] inline Pair smaller(Pair a, Pair b) {
#if defined(__SSE2__)
  return _mm_min_pd(a, b);
#else
  return a < b ? a : b;
#endif
}

[[gnu::always_inline]] inline Pair larger(Pair a, Pair b) {
#if defined(__SSE2__)
  return _mm_max_pd(a, b);
#else
  return a > b ? a : b;
#endif
}

/// Bit i: `a` is at most `b` in coordinate i; false for NaN.
[[gnu::always_inline]] inline unsigned at_most(Pair a, Pair b) {
#if defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_pd(_mm_cmple_pd(a, b)));
#else
  return static_cast<unsigned>(a[0] <= b[0]) | static_cast<unsigned>(a[1] <= b[1]) << 1;
#endif
}

/// Whether both are within the limit; false for NaN.
[[gnu::always_inline]] inline bool within(Pair query, double limit) {
  return std::abs(query[0]) <= limit && std::abs(query[1]) <= limit;
}

}  // namespace calligraphy
