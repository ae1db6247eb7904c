// Random points that are identical on every platform.
#pragma once

#include <calligraphy/base/random.hpp>
#include <calligraphy/model/point.hpp>

namespace calligraphy {

class RandomPoints : public Random {
 public:
  using Random::Random;

  Point point(double low, double high) {
    const double x = between(low, high);
    return {x, between(low, high)};
  }
  /// A point within the unit disc.
  Point in_disc() {
    for (;;) {
      const Point candidate = point(-1.0, 1.0);
      if (candidate.squaredNorm() <= 1.0) return candidate;
    }
  }
  /// A unit vector. Avoids sine, which libraries round differently.
  Point direction() {
    for (;;) {
      const Point candidate = in_disc();
      if (candidate.squaredNorm() > 1e-2) return candidate / candidate.norm();
    }
  }
};

}  // namespace calligraphy
