// Proves how near a Bezier curve comes to the origin, in long double or quadruple precision.
//
// Independent of the code under test: it never looks for zeros of the slope. The Bernstein ordinates of |B(t)|^2 bound
// it from below on a part of the curve; parts are bisected until their ordinates show that nothing there is nearer than
// the result, or that the square is convex there, where one point and its slope give the bound. Every rounding error is
// accounted for, so `least` is a proof and not an estimate.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace calligraphy_test {

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 Quadruple;
#else
using Quadruple = long double;
#endif

namespace oracle {

template <typename Real>
struct Vector {
  Real x, y;
};

template <typename Real>
constexpr Real dot(const Vector<Real>& a, const Vector<Real>& b) {
  return a.x * b.x + a.y * b.y;
}

/// Distance from 1 to the next larger number.
template <typename Real>
constexpr Real epsilon() {
  Real value = 1;
  while (Real(1) + value / 2 != Real(1)) value /= 2;
  return value;
}

/// Accurate to a few units in the last place; in quadruple precision by one step of Newton's method, which needs no
/// library.
template <typename Real>
Real square_root(Real value) {
  const long double rough = value > 0 ? std::sqrt(static_cast<long double>(value)) : 0.0L;
  const auto root = static_cast<Real>(rough);
  return std::is_same_v<Real, long double> || !(root > 0) ? root : (root + value / root) / 2;
}

constexpr int binomial(int n, int k) { return k == 0 ? 1 : binomial(n - 1, k - 1) * n / k; }

/// Coefficient of D_i . D_j in the Bernstein ordinate i + j of the square of a curve of degree n.
template <typename Real, int n>
constexpr auto square_weights() {
  std::array<std::array<Real, n + 1>, n + 1> weights = {};
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      weights[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
          static_cast<Real>(binomial(n, i) * binomial(n, j)) / static_cast<Real>(binomial(2 * n, i + j));
    }
  }
  return weights;
}

struct Bounds {
  long double least = 0.0L;  ///< proven: no point of the range is nearer than this
  long double found = 0.0L;  ///< distance of some point of the range, up to rounding
  int parts = 0;             ///< number of parts into which the curve was divided
};

/// The search for the minimum distance of the origin from one curve of degree n, given by its control points.
template <typename Real, int n>
class MinDistance {
 public:
  using Polygon = std::array<Vector<Real>, n + 1>;

  /// `upper` is the distance of some point of the curve and `hint` its parameter; `tight` is how close below the
  /// minimum distance the bound should be, where the curve permits it; the bound need not exceed `enough`.
  Bounds run(const Polygon& polygon, Real upper, Real hint, Real tight, Real enough) {
    Real magnitude = 0;
    for (const auto& point : polygon) magnitude = std::max({magnitude, size_of(point.x), size_of(point.y)});
    tight_ = std::max(tight, 256 * unit * magnitude);
    hint_ = hint;
    found_ = upper * upper;
    least_ = std::min(upper, enough) * std::min(upper, enough);
    aim_below(least_);
    stack_[0] = {polygon, 0, 1, 0};
    depth_ = 1;
    while (depth_ > 0 && goal_ > 0) examine(stack_[--depth_]);
    if (!(goal_ > 0)) least_ = 0;
    // Rounding before this search (differences, restriction to a range) and in each bisection moves the polygon.
    const Real moved = 2 * static_cast<Real>(32 + n * deepest_) * unit * magnitude;
    const Real least = square_root(least_) * (1 - 4 * unit) - moved;
    return {static_cast<long double>(std::max(least, Real(0))), static_cast<long double>(square_root(found_)), parts_};
  }

 private:
  static constexpr int degree = 2 * n;
  static constexpr Real unit = epsilon<Real>() / 2;
  static constexpr int depth_limit = 100;
  static constexpr int part_limit = 4000;
  static constexpr auto weights = square_weights<Real, n>();

  struct Part {
    Polygon polygon;
    Real begin, width;
    int depth;
  };

  static Real size_of(Real value) { return value < 0 ? -value : value; }

  void find(Real square) {
    if (square >= found_) return;
    found_ = square;
    if (square < reached_) aim_below(square);
  }

  void aim_below(Real square) {
    reached_ = square;
    const Real goal = square_root(square) - tight_;
    goal_ = goal > 0 ? goal * goal : 0;
  }

  void examine(const Part& part) {
    ++parts_;
    deepest_ = std::max(deepest_, part.depth);
    const Polygon& p = part.polygon;
    std::array<Real, degree + 1> ordinates = {};
    Real largest = 0;
    for (std::size_t i = 0; i <= n; ++i) {
      const Real square = dot(p[i], p[i]);
      largest = std::max(largest, square);
      ordinates[2 * i] += weights[i][i] * square;
      for (std::size_t j = i + 1; j <= n; ++j) ordinates[i + j] += 2 * weights[i][j] * dot(p[i], p[j]);
    }
    const Real noise = 16 * unit * largest;
    std::size_t lowest = 0;
    for (std::size_t k = 1; k <= degree; ++k) {
      if (ordinates[k] < ordinates[lowest]) lowest = k;
    }
    const bool at_end = lowest == 0 || lowest == degree;  // then that end is the nearest point of the part
    if (at_end) find(ordinates[lowest]);
    const Real floor = ordinates[lowest] - noise;
    if (at_end || floor >= goal_ || part.depth == depth_limit || parts_ > part_limit) {
      least_ = std::min(least_, floor);
      return;
    }
    Real bend = ordinates[2] - 2 * ordinates[1] + ordinates[0];
    for (std::size_t k = 1; k + 2 <= degree; ++k) {
      bend = std::min(bend, ordinates[k + 2] - 2 * ordinates[k + 1] + ordinates[k]);
    }
    bend -= 8 * noise;
    if (bend > 0 && bound_convex(part, lowest, bend * (degree * (degree - 1)), largest)) return;
    halve(part);
  }

  /// On a part where the second derivative of the square is at least `curvature`, a point with square f and slope g
  /// bounds it from below by f - g^2 / (2 curvature). False when bisection would give a better bound.
  bool bound_convex(const Part& part, std::size_t lowest, Real curvature, Real largest) {
    Real t = (hint_ - part.begin) / part.width;
    if (!(t > 0 && t < 1)) t = static_cast<Real>(static_cast<int>(lowest)) / degree;
    for (int step = 0; step < 8; ++step) {
      Polygon row = part.polygon;
      Vector<Real> second = {0, 0}, slope = {0, 0};
      for (std::size_t count = n; count > 0; --count) {
        if (count == 2) {
          second = {n * (n - 1) * (row[2].x - 2 * row[1].x + row[0].x),
                    n * (n - 1) * (row[2].y - 2 * row[1].y + row[0].y)};
        }
        if (count == 1) slope = {n * (row[1].x - row[0].x), n * (row[1].y - row[0].y)};
        for (std::size_t i = 0; i < count; ++i) {
          row[i].x += t * (row[i + 1].x - row[i].x);
          row[i].y += t * (row[i + 1].y - row[i].y);
        }
      }
      const Real square = dot(row[0], row[0]);
      const Real g = 2 * dot(row[0], slope);
      const Real steepest = size_of(g) + 1000 * unit * largest;
      const Real slack = steepest * steepest / (2 * curvature);
      const Real floor = square - slack - 64 * unit * largest;
      find(square);
      if (floor >= goal_) {
        least_ = std::min(least_, floor);
        return true;
      }
      if (slack <= 8 * unit * largest) return false;  // converged: only a shorter part reduces the noise
      const Real second_derivative = 2 * (dot(slope, slope) + dot(row[0], second));
      t -= g / std::max(second_derivative, curvature);
      t = std::min(std::max(t, Real(0)), Real(1));
    }
    return false;
  }

  void halve(const Part& part) {
    // The stack holds at most one part of each depth, plus one.
    Part& right = stack_[static_cast<std::size_t>(depth_)];
    Part& left = stack_[static_cast<std::size_t>(depth_) + 1];
    const Polygon polygon = part.polygon;
    const Real begin = part.begin, width = part.width / 2;
    const int depth = part.depth + 1;
    right = {polygon, begin + width, width, depth};
    left = {polygon, begin, width, depth};
    for (std::size_t count = n; count > 0; --count) {
      for (std::size_t i = 0; i < count; ++i) {
        right.polygon[i].x = (right.polygon[i].x + right.polygon[i + 1].x) / 2;
        right.polygon[i].y = (right.polygon[i].y + right.polygon[i + 1].y) / 2;
      }
      left.polygon[n + 1 - count] = right.polygon[0];
    }
    depth_ += 2;
  }

  std::array<Part, depth_limit + 2> stack_;
  int depth_ = 0;
  Real hint_ = 0, tight_ = 0;
  Real least_ = 0, found_ = 0;
  Real reached_ = 0, goal_ = 0;  ///< the square to be proven from below, and what is near enough to it
  int parts_ = 0, deepest_ = 0;
};

}  // namespace oracle
}  // namespace calligraphy_test
