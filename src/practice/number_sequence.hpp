// Numbers that look random and are the same on every machine.
#pragma once

#include <cstdint>

#include <calligraphy/model/point.hpp>

namespace calligraphy {

/// splitmix64. The standard's distributions differ between libraries; this does not.
class NumberSequence {
 public:
  explicit NumberSequence(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  /// In [0, 1).
  double next() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
  double between(double low, double high) { return low + (high - low) * next(); }
  /// 0 to count - 1.
  std::uint64_t index(std::uint64_t count) { return bits() % count; }
  Point point(double low, double high) {
    const double x = between(low, high);
    return {x, between(low, high)};
  }
  /// Within the unit disc.
  Point in_disc() {
    for (;;) {
      const Point candidate = point(-1.0, 1.0);
      if (candidate.squaredNorm() <= 1.0) return candidate;
    }
  }
  /// Of length 1. No sine: libraries round it differently.
  Point direction() {
    for (;;) {
      const Point candidate = in_disc();
      if (candidate.squaredNorm() > 1e-2) return candidate / candidate.norm();
    }
  }

 private:
  std::uint64_t state_;
};

}  // namespace calligraphy
