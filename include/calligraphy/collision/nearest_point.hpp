// Nearest point on a stroke element (Wang 2006, sec. 4.3.1 and 4.3.2). Choosing a method: docs/nearest-point.md.
#pragma once

#include <span>

#include <calligraphy/collision/stroke_element.hpp>

namespace calligraphy {

/// On a line or a point every method returns the foot of the perpendicular, clamped to the range, and certifies it.
enum class NearestPointMethod {
  exact,    ///< the global nearest point, certified by the signs of the slope of the squared distance
  tracked,  ///< the same point, searched from the last one: for queries that move little from call to call
  sampled,  ///< the best of some samples, refined: fast, but wrong where another branch is nearly as near
  wang2006  ///< subdivision as printed in sec. 4.3.2, ties to the nearer midpoint; misses branches: docs/wang2006.md
};

/// "exact", "tracked", "sampled", "wang2006".
const char* to_string(NearestPointMethod method) noexcept;

/// Method and settings of a nearest-point query.
struct NearestPointOptions {
  NearestPointMethod method = NearestPointMethod::exact;  ///< search method; each other option says which use it
  /// exact, tracked: error of the point; wang2006: epsilon. Both relative to the size of the element, in (0, 1]. A
  /// value of 0 or less requests more than rounding allows: the result may then be only approximate.
  double tolerance = 1e-9;
  int samples = 16;     ///< sampled: points at equal parameter spacing, clamped to [2, 64]
  int refinements = 2;  ///< sampled: steps of Halley's method, clamped to [0, 8]
};

/// Rejects, at set-up, values that nearest_point() would clamp. @throws ValueError naming the option and its value
void validate(const NearestPointOptions& options);

/// Validity of a nearest point.
enum class NearestPointStatus {
  certified,    ///< no other point of the range is nearer, within the tolerance and rounding
  approximate,  ///< not certified: sampled or wang2006 on a curve, or exact at its work limit
  unsafe_stop,  ///< wang2006 stopped although its last interval holds a point nearer by more than epsilon
  not_finite    ///< the query or the element is not finite, or the query is farther than 1e100 sizes from an element of
                ///< nonzero size: returns the start of the range and an infinite distance
};

/// The point of an element that is nearest to a query, in the unit of its control points.
struct NearestPoint {
  double parameter = 0.0;         ///< of the point, in [0, 1]
  Point point = Point::Zero();    ///< on the curve (wang2006: midpoint of two points on it)
  double distance = 0.0;          ///< from the query to `point`; infinite if one is not finite
  Point tangent = Point::Zero();  ///< unit vector in writing direction; zero for a point
  NearestPointStatus status = NearestPointStatus::approximate;  ///< how far the result may be trusted

  /// Whether no other point of the range is nearer, within the tolerance and rounding.
  bool certified() const noexcept { return status == NearestPointStatus::certified; }
};

/// Part of an element. Values outside [0, 1] are clamped, NaN becomes 0 for `begin` and 1 for `end`, and an `end`
/// before `begin` becomes `begin`.
struct ParameterRange {
  double begin = 0.0;  ///< first parameter
  double end = 1.0;    ///< last parameter, included
};

/// Nearest point of the element within the range. Of equal distances the smaller parameter wins. `start`, used by
/// tracked only, is the parameter of the last result; it affects the time taken, never the branch found.
///
/// The result is the same to the last bit on every processor and in batches. Work is bounded: at most 256 intervals
/// (exact, tracked), 64 bisections (wang2006).
NearestPoint nearest_point(const StrokeElement& element, const Point& query, const NearestPointOptions& options = {},
                           const ParameterRange& range = {}, double start = 0.5) noexcept;

/// Nearest points of many queries on one element: `results[i]` belongs to `queries[i]` and equals that of a single
/// query; exact is faster this way. If the spans differ in length, the excess of the longer one is ignored.
void nearest_points(const StrokeElement& element, std::span<const Point> queries, std::span<NearestPoint> results,
                    const NearestPointOptions& options = {}) noexcept;

}  // namespace calligraphy
