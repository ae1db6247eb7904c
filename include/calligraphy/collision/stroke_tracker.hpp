// Nearest point of a whole stroke, tracked from tick to tick.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <calligraphy/collision/nearest_stroke_point.hpp>

namespace calligraphy {

/// Finds the certified nearest point of the whole stroke for each position of a pen, fast as long as the pen moves
/// little: the search on the last nearest element starts from its last parameter, and the other elements are skipped
/// until the pen has travelled far enough to be as near to them. Of distances that are equal within rounding the
/// earlier element wins. An element that cannot answer is ignored if another can.
class StrokeTracker {
 public:
  /// Keeps a view of the elements, of which a stroke has at most 5. `tolerance` is as in NearestPointOptions.
  /// @throws ValueError if there are more, and naming the tolerance unless it is above 0 and at most 1
  explicit StrokeTracker(std::span<const StrokeElement> elements, double tolerance = 1e-9);
  StrokeTracker(std::vector<StrokeElement>&&, double = 0.0) = delete;  // would dangle before the first update

  /// Nearest point of the whole stroke to the next position of the pen. If the query is not finite, returns the start
  /// of the last nearest element with status not_finite and does not remember the query. For a stroke without elements,
  /// always returns the origin with status not_finite.
  StrokePoint update(const Point& query) noexcept;

 private:
  /// What is known of an element.
  struct Track {
    double parameter = 0.5;
    double step = 0.0;            ///< last change of the parameter
    Point query = Point::Zero();  ///< that of the last comparison
    double clearance = 0.0;       ///< its distance then, minus the possible rounding error
  };

  NearestPoint find_on(int element, const Point& query) noexcept;
  /// Looks for a nearer point on the other elements.
  void compare(const Point& query, StrokePoint& nearest) noexcept;
  void keep(int element, const Point& query, double distance) noexcept;
  /// No point of the element is nearer to the query.
  double clearance_of(int element, const Point& query) const noexcept;

  std::span<const StrokeElement> elements_;
  double tolerance_;
  double clearance_;                  ///< no other element than the last nearest is nearer to the query...
  Point last_query_ = Point::Zero();  ///< ...of the last comparison
  std::array<Track, max_elements_per_stroke> tracks_ = {};
  int last_ = 0;
};

}  // namespace calligraphy
