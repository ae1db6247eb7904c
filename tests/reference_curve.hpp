// An independent Bezier curve in long double: de Casteljau, dense sampling and golden-section search. Slow and simple.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <calligraphy/model/point.hpp>

namespace calligraphy_test {

using calligraphy::Point;

class ReferenceCurve {
 public:
  using Real = long double;
  using Vector = std::array<Real, 2>;

  explicit ReferenceCurve(const std::vector<Point>& points) : count_(points.size()) {
    for (std::size_t i = 0; i < count_; ++i) points_[i] = {points[i].x(), points[i].y()};
  }

  Vector point(Real t) const { return casteljau(points_, count_, t); }

  Vector derivative(Real t) const {
    Row differences = {};
    const Real degree = static_cast<Real>(count_ - 1);
    for (std::size_t i = 0; i + 1 < count_; ++i) {
      for (std::size_t axis = 0; axis < 2; ++axis)
        differences[i][axis] = degree * (points_[i + 1][axis] - points_[i][axis]);
    }
    return casteljau(differences, count_ - 1, t);
  }

  Real distance(const Point& query, Real t) const {
    const Vector at = point(t);
    return std::hypot(at[0] - query.x(), at[1] - query.y());
  }

  struct Nearest {
    Real parameter;
    Real distance;
  };

  /// Global nearest point within [begin, end]: every local minimum of the samples, refined by golden-section search.
  Nearest nearest(const Point& query, Real begin = 0.0L, Real end = 1.0L, int samples = 800) const {
    std::vector<Real> distances;
    const auto at = [&](int i) { return begin + (end - begin) * static_cast<Real>(i) / static_cast<Real>(samples); };
    for (int i = 0; i <= samples; ++i) distances.push_back(distance(query, at(i)));
    const Real least = *std::min_element(distances.begin(), distances.end());
    Nearest best{begin, distances[0]};
    // No point between two samples is nearer than their distances minus the path between them.
    const Real reach = speed_bound() * (end - begin) / static_cast<Real>(samples);
    std::vector<int> minima;
    for (int i = 0; i <= samples; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (i > 0 && distances[k - 1] < distances[k]) continue;
      if (i < samples && distances[k + 1] < distances[k]) continue;
      if (distances[k] <= least + reach) minima.push_back(i);
    }
    // More than a few are the rounding noise of a flat minimum, where any of them is acceptable.
    for (std::size_t k = 0; k < minima.size(); k += 1 + minima.size() / 16) {
      const int i = minima[k];
      const Nearest found = golden(query, at(std::max(i - 1, 0)), at(std::min(i + 1, samples)));
      if (found.distance < best.distance) best = found;
    }
    const Real at_end = distances.back();
    return at_end < best.distance ? Nearest{end, at_end} : best;
  }

  /// Arc length from 0 to t by composite Gauss-Legendre quadrature with 3 nodes.
  Real arc_length(Real t, int parts = 2000) const {
    const Real node = std::sqrt(0.6L);
    Real sum = 0.0L;
    for (int i = 0; i < parts; ++i) {
      const Real half = 0.5L * t / static_cast<Real>(parts);
      const Real middle = (2.0L * static_cast<Real>(i) + 1.0L) * half;
      sum += half * (5.0L * speed(middle - half * node) + 8.0L * speed(middle) + 5.0L * speed(middle + half * node)) /
             9.0L;
    }
    return sum;
  }

 private:
  using Row = std::array<Vector, 5>;

  static Vector casteljau(Row row, std::size_t points, Real t) {
    for (std::size_t count = points; count > 1; --count) {
      for (std::size_t i = 0; i + 1 < count; ++i) {
        for (std::size_t axis = 0; axis < 2; ++axis) row[i][axis] += t * (row[i + 1][axis] - row[i][axis]);
      }
    }
    return row[0];
  }

  Real speed(Real t) const {
    const Vector slope = derivative(t);
    return std::hypot(slope[0], slope[1]);
  }

  Real speed_bound() const {
    Real bound = 0.0L;
    for (std::size_t i = 0; i + 1 < count_; ++i) {
      bound = std::max(bound, std::hypot(points_[i + 1][0] - points_[i][0], points_[i + 1][1] - points_[i][1]));
    }
    return bound * static_cast<Real>(count_ - 1);
  }

  Nearest golden(const Point& query, Real low, Real high) const {
    const Real ratio = (std::sqrt(5.0L) - 1.0L) / 2.0L;
    Real a = high - ratio * (high - low), b = low + ratio * (high - low);
    Real at_a = distance(query, a), at_b = distance(query, b);
    for (int step = 0; step < 70; ++step) {
      if (at_a <= at_b) {
        high = b, b = a, at_b = at_a;
        a = high - ratio * (high - low), at_a = distance(query, a);
      } else {
        low = a, a = b, at_a = at_b;
        b = low + ratio * (high - low), at_b = distance(query, b);
      }
    }
    return at_a <= at_b ? Nearest{a, at_a} : Nearest{b, at_b};
  }

  std::size_t count_;
  Row points_ = {};
};

}  // namespace calligraphy_test
