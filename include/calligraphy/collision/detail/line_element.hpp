// A line segment of a stroke, or a point: the LSE of the paper (Wang 2006, sec. 3.3).
#pragma once

#include <calligraphy/model/point.hpp>

namespace calligraphy::detail {

/// B(t) = origin + t * edge. 56 bytes.
struct LineElement {
  Point origin = Point::Zero();
  Point edge = Point::Zero();       ///< from start to end [m]
  Point direction = Point::Zero();  ///< unit vector along the edge; zero for a point
  double length = 0.0;              ///< [m]

  Point point(double t) const noexcept { return origin + t * edge; }
};

LineElement prepare_line(const Point& start, const Point& end) noexcept;

}  // namespace calligraphy::detail
