// Verifies answers to "which point of the curve is nearest?" by a proof independent of the code under test.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include <calligraphy/collision/nearest_point.hpp>

#include "min_distance.hpp"

namespace calligraphy_test {

using calligraphy::NearestPoint;
using calligraphy::NearestPointMethod;
using calligraphy::ParameterRange;
using calligraphy::Point;

inline constexpr NearestPointMethod certified_methods[] = {NearestPointMethod::exact, NearestPointMethod::tracked};
inline constexpr NearestPointMethod all_methods[] = {NearestPointMethod::exact, NearestPointMethod::tracked,
                                                     NearestPointMethod::sampled, NearestPointMethod::wang2006};

/// The verdict on an answer. Errors are relative to the size of the curve (of a point: to the distance).
struct Verdict {
  /// How much farther the curve at the answer's parameter is than the nearest point of the range: at most this, and at
  /// least `surely`.
  double error = 0.0;
  double surely = 0.0;
  double share = 0.0;         ///< error relative to the allowed error
  bool plain = false;         ///< the allowed error is 1e-9 of the size: rounding of large coordinates plays no part
  bool consistent = false;    ///< parameter within the range, point and distance match it, tangent a unit vector
  bool right = false;         ///< consistent, and the error is allowed
  bool wrong_branch = false;  ///< certainly farther by more than 1e-3 of the size, and by more than rounding explains
};

/// The ground truth about one curve. Control points and queries are finite.
class NearestPointOracle {
 public:
  explicit NearestPointOracle(std::span<const Point> control_points) : count_(control_points.size()) {
    Point low = control_points[0], high = control_points[0];
    for (std::size_t i = 0; i < count_; ++i) {
      points_[i] = control_points[i];
      low = low.cwiseMin(control_points[i]);
      high = high.cwiseMax(control_points[i]);
      coordinate_ = std::max(coordinate_, control_points[i].cwiseAbs().maxCoeff());
    }
    low_ = low;
    high_ = high;
    size_ = std::hypot(high.x() - low.x(), high.y() - low.y());
  }

  /// Diagonal of the bounding box of the control points.
  double size() const { return size_; }

  /// Allowed error of an answer [as the coordinates]: 1e-9 of the size, or 1e-6 where the coordinates are so large that
  /// their own resolution approaches that, plus what rounding of the distance explains. Where the curve is part of
  /// something larger, the size of the whole counts, and two distances were compared.
  double allowance(const Point& query, double distance, double whole_size = 0.0) const {
    const double size = std::max(size_, whole_size);
    constexpr double step = std::numeric_limits<double>::epsilon();
    const double steps = 4.0 * step * std::max(coordinate_, query.cwiseAbs().maxCoeff());
    const double of_size = 4.0 * step * coordinate_ > 1e-9 * size ? 1e-6 * size : 1e-9 * size;
    return std::max(of_size, steps) + (whole_size > 0.0 ? 8.0 : 4.0) * step * distance;
  }

  /// The point of the curve at t, relative to the query.
  oracle::Vector<long double> offset(const Point& query, long double t) const {
    std::array<oracle::Vector<long double>, 5> row;
    for (std::size_t i = 0; i < count_; ++i) row[i] = relative<long double>(i, query);
    for (std::size_t count = count_ - 1; count > 0; --count) {
      for (std::size_t i = 0; i < count; ++i) {
        row[i].x += t * (row[i + 1].x - row[i].x);
        row[i].y += t * (row[i + 1].y - row[i].y);
      }
    }
    return row[0];
  }

  long double distance(const Point& query, long double t) const {
    const auto at = offset(query, t);
    return std::hypot(at.x, at.y);
  }

  /// No point of the curve is nearer to the query than this.
  double box_distance(const Point& query) const {
    const Point outside = (low_ - query).cwiseMax(query - high_).cwiseMax(0.0);
    return (1.0 - 1e-15) * std::hypot(outside.x(), outside.y());
  }

  /// The distance of the nearest point of the range. The hint may be any parameter of the range; a good one is fastest.
  /// In quadruple precision only where long double cannot decide within the allowed error, or when requested.
  oracle::Bounds nearest(const Point& query, long double hint, const ParameterRange& range = {},
                         bool quadruple = false) const {
    constexpr long double no_end = 1e300L;
    if (!quadruple) {
      const oracle::Bounds bounds = search<long double>(query, hint, range, no_end);
      if (bounds.found - bounds.least <= 0.1L * allowance(query, static_cast<double>(bounds.found))) return bounds;
    }
    return search<Quadruple>(query, hint, range, no_end);
  }

  /// The same for the whole curve, but with `least` no larger than `enough`: cheap for a curve that is clearly farther.
  oracle::Bounds nearest_within(const Point& query, long double enough) const {
    const oracle::Bounds bounds = search<long double>(query, 0.5L, {}, enough);
    const long double reached = std::min(bounds.found, enough);
    if (reached - bounds.least <= 0.1L * allowance(query, static_cast<double>(reached))) return bounds;
    return search<Quadruple>(query, 0.5L, {}, enough);
  }

  /// Verifies an answer by the bounds of `nearest` for the same query and range.
  Verdict judge(const NearestPoint& answer, const Point& query, const oracle::Bounds& bounds,
                const ParameterRange& range = {}, double whole_size = 0.0) const {
    Verdict verdict;
    if (!answer.point.allFinite() || !answer.tangent.allFinite() || !std::isfinite(answer.distance) ||
        !(answer.parameter >= range.begin && answer.parameter <= range.end)) {
      verdict.error = verdict.surely = std::numeric_limits<double>::infinity();
      return verdict;
    }
    const auto at = offset(query, answer.parameter);
    const long double true_distance = std::hypot(at.x, at.y);
    const long double allowed = allowance(query, answer.distance, whole_size);
    const long double beside = std::hypot(static_cast<long double>(answer.point.x()) - query.x() - at.x,
                                          static_cast<long double>(answer.point.y()) - query.y() - at.y);
    const double unit = answer.tangent.norm();
    const double larger = std::max(size_, whole_size);
    const long double size = larger > 0.0 ? larger : std::max(answer.distance, std::numeric_limits<double>::min());
    const long double error = true_distance - bounds.least, surely = true_distance - bounds.found;
    verdict.error = static_cast<double>(std::max(error, 0.0L) / size);
    verdict.surely = static_cast<double>(std::max(surely, 0.0L) / size);
    verdict.share = static_cast<double>(std::max(error, 0.0L) / std::max(allowed, 1e-4900L));
    verdict.plain = allowed <= 1.01e-9L * size;
    verdict.consistent = beside <= allowed && std::abs(answer.distance - true_distance) <= allowed &&
                         (size_ > 0.0 ? std::abs(unit - 1.0) <= 1e-9 : unit == 0.0);
    verdict.right = verdict.consistent && error <= allowed;
    verdict.wrong_branch = surely > std::max(1e-3L * size, allowed);
    return verdict;
  }

 private:
  template <typename Real>
  oracle::Vector<Real> relative(std::size_t i, const Point& query) const {
    return {static_cast<Real>(points_[i].x()) - static_cast<Real>(query.x()),
            static_cast<Real>(points_[i].y()) - static_cast<Real>(query.y())};
  }

  template <typename Real>
  oracle::Bounds search(const Point& query, long double hint, const ParameterRange& range, long double enough) const {
    switch (count_) {
      case 2:
        return search_degree<Real, 1>(query, hint, range, enough);
      case 3:
        return search_degree<Real, 2>(query, hint, range, enough);
      case 4:
        return search_degree<Real, 3>(query, hint, range, enough);
      default:
        return search_degree<Real, 4>(query, hint, range, enough);
    }
  }

  template <typename Real, int n>
  oracle::Bounds search_degree(const Point& query, long double hint, const ParameterRange& range,
                               long double enough) const {
    typename oracle::MinDistance<Real, n>::Polygon polygon;
    for (std::size_t i = 0; i <= n; ++i) polygon[i] = relative<Real>(i, query);
    const long double width = static_cast<long double>(range.end) - range.begin;
    if (!(width > 0.0L)) return {distance_floor(query, range.begin), distance(query, range.begin), 1};
    if (range.begin != 0.0 || range.end != 1.0) {
      const auto whole = polygon;
      for (std::size_t k = 0; k <= n; ++k) polygon[k] = blossom<Real, n>(whole, range, k);
    }
    constexpr long double tight = 1e-14L;
    hint = std::clamp(hint, static_cast<long double>(range.begin), static_cast<long double>(range.end));
    return oracle::MinDistance<Real, n>().run(polygon, static_cast<Real>(distance(query, hint)),
                                              static_cast<Real>((hint - range.begin) / width),
                                              static_cast<Real>(tight * size_), static_cast<Real>(enough));
  }

  long double distance_floor(const Point& query, long double t) const {
    const long double at = distance(query, t);
    return at - std::min(at, 64.0L * std::numeric_limits<long double>::epsilon() *
                                 (size_ + query.cwiseAbs().maxCoeff() + coordinate_));
  }

  /// Control point k of the part of the curve within the range: the blossom at n - k times its begin and k times its
  /// end.
  template <typename Real, int n>
  static oracle::Vector<Real> blossom(std::array<oracle::Vector<Real>, n + 1> row, const ParameterRange& range,
                                      std::size_t k) {
    for (std::size_t count = n; count > 0; --count) {
      const Real t = static_cast<Real>(count <= k ? range.end : range.begin);
      for (std::size_t i = 0; i < count; ++i) {
        row[i].x = (1 - t) * row[i].x + t * row[i + 1].x;
        row[i].y = (1 - t) * row[i].y + t * row[i + 1].y;
      }
    }
    return row[0];
  }

  std::size_t count_;
  std::array<Point, 5> points_;
  Point low_, high_;
  double size_ = 0.0, coordinate_ = 0.0;
};

}  // namespace calligraphy_test
