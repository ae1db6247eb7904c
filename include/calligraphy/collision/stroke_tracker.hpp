// The nearest point over all elements of a stroke, from tick to tick.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <calligraphy/collision/nearest_point.hpp>

namespace calligraphy {

/// A point of a stroke.
struct StrokePoint {
  int element = 0;  ///< index
  NearestPoint closest;
};

/// Finds for each position of a pen the nearest point of the whole stroke, certified, and quickly where the pen moves
/// little: the element of the last answer starts from the last parameter, and an element is left alone until the pen
/// has travelled far enough to come as near to it. Equal distances go to the earlier element.
class StrokeTracker {
 public:
  /// Keeps a view of the elements, of the first 5 if there are more. `tolerance` as in NearestPointOptions.
  explicit StrokeTracker(std::span<const StrokeElement> elements, double tolerance = 1e-9) noexcept;
  StrokeTracker(std::vector<StrokeElement>&&, double = 0.0) = delete;  // would be gone before the first update

  /// A query that is not finite is answered by the start of the element that was nearest last, status not_finite, and
  /// is not remembered. A stroke without elements answers every query by the origin, status not_finite.
  StrokePoint update(const Point& query) noexcept;

 private:
  /// What is known of an element from the last time it was asked.
  struct Sighting {
    Point query = Point::Zero();
    double clearance = 0.0;  ///< the distance, less what may be rounding
    double parameter = 0.5;
    double step = 0.0;  ///< the last change of the parameter
  };

  NearestPoint look(int element, const Point& query) noexcept;

  std::span<const StrokeElement> elements_;
  NearestPointOptions options_;
  std::array<Sighting, max_elements_per_stroke> sightings_ = {};
  int last_ = 0;
};

}  // namespace calligraphy
