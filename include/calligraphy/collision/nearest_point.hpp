// Nearest point on a stroke element (Wang 2006, sec. 4.3.1 and 4.3.2).
#pragma once

#include <calligraphy/collision/stroke_element.hpp>

namespace calligraphy {

enum class NearestPointMethod {
  exact,    ///< the global nearest point, by isolating every minimum; the perpendicular foot on a line
  wang2006  ///< subdivision as printed in sec. 4.3.2, ties to the nearer middle; misses branches, see docs/wang2006.md
};

struct NearestPointOptions {
  NearestPointMethod method = NearestPointMethod::exact;
  /// exact: error of the point; wang2006: epsilon. Both relative to the size of the element. (0, 1]
  double tolerance = 1e-9;
};

struct NearestPoint {
  double parameter = 0.0;         ///< in [0, 1]
  Point point = Point::Zero();    ///< on the curve (wang2006: the middle between two points of it)
  double distance = 0.0;          ///< from the query to `point`; infinite when the query is not finite
  Point tangent = Point::Zero();  ///< unit vector in writing direction; zero for a point
  bool certified = false;         ///< no other point of the range is nearer, up to rounding
};

/// Part of an element.
struct ParameterRange {
  double begin = 0.0;
  double end = 1.0;
};

/// Nearest point of the element within the range. Equal distances go to the smaller parameter. A query that is not
/// finite gives the start of the range, uncertified. Bounded work: at most 256 intervals (exact), 64 halvings
/// (wang2006).
NearestPoint nearest_point(const StrokeElement& element, const Point& query, const NearestPointOptions& options = {},
                           const ParameterRange& range = {}) noexcept;

}  // namespace calligraphy
