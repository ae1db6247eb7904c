// Two coordinates in one register, for the searches. Built into the compiler, so that nothing of it is ever called: a
// call from code for wider registers into Eigen's would cost more than the query.
#pragma once

#include <cmath>
#include <cstring>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

using Pair = double __attribute__((vector_size(16)));

[[gnu::always_inline]] inline Pair pair(const Point& point) {
  Pair both;
  std::memcpy(&both, point.data(), sizeof both);
  return both;
}

[[gnu::always_inline]] inline double dot(Pair a, Pair b) {
  const Pair product = a * b;
  return product[0] + product[1];
}

/// False for NaN, too.
[[gnu::always_inline]] inline bool within(Pair query, double limit) {
  return std::abs(query[0]) <= limit && std::abs(query[1]) <= limit;
}

}  // namespace calligraphy
