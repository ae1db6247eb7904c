// Where a label beside a point is read: not on what is already drawn.
#pragma once

#include <vector>

#include <calligraphy/model/point.hpp>

namespace calligraphy::svg {

/// A rectangle, y down [px].
struct Box {
  Point low, high;
};

/// Common area of two rectangles [px^2].
double common_area(const Box& a, const Box& b);

/// Puts a label of this size beside a point, on either side, above or below it, and if need be farther away: the first
/// place within `picture` that covers nothing of `taken`, otherwise the one that covers least.
Box place_label(const Point& point, const Point& size, const Box& picture, const std::vector<Box>& taken);

}  // namespace calligraphy::svg
