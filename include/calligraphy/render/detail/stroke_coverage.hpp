// How much of a stroke has been written, in order and near enough.
#pragma once

#include <calligraphy/collision/active_stroke.hpp>
#include <calligraphy/render/detail/stroke_capture.hpp>

namespace calligraphy {

/// Progress of a pen along a stroke that it may have begun beside its start: the offset at the beginning is removed
/// along the stroke and tolerated across it, for as long as the pen keeps it. Never allocates.
class StrokeCoverage {
 public:
  /// The stroke with this start is begun at `begin` [m].
  void restart(const Point& begin, const StrokeStart& start) noexcept;

  /// The pen is at `tip`; progress counts while it deviates by at most `corridor` [m].
  void update(const Point& tip, const StrokeContact& contact, double length, double corridor) noexcept;

  /// Share of `length` [m] that is covered.
  double share(double length) const noexcept;

  /// Whether the pen was in the corridor for most of its way: a wave about the stroke is not.
  bool keeps_in_corridor() const noexcept;

  /// How far beyond its start the stroke was begun [m].
  double late() const noexcept { return ahead_ > 0.0 ? ahead_ : 0.0; }

 private:
  StrokeStart start_;
  Point offset_ = Point::Zero();     ///< from the start [m]
  Point tolerated_ = Point::Zero();  ///< what is left of it across the stroke [m]
  Point last_ = Point::Zero();       ///< pen tip [m]
  double furthest_ = 0.0;            ///< arc length, the offset removed [m]
  double covered_ = 0.0;             ///< arc length [m]
  double owed_ = 0.0;                ///< of the corner that was passed [m]
  double way_ = 0.0;                 ///< length of the pen's path [m]
  double outside_ = 0.0;             ///< outside the corridor [m]
  double ahead_ = 0.0;               ///< offset along the stroke at its beginning [m]
};

}  // namespace calligraphy
