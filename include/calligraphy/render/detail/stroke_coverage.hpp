// How much of a stroke has been written, in order and near enough.
#pragma once

#include <calligraphy/collision/active_stroke.hpp>

namespace calligraphy {

/// Progress of a pen along a stroke that it may have begun beside its start: the offset at the beginning is removed
/// along the stroke and tolerated across it, for as long as the pen keeps it. Never allocates.
class StrokeCoverage {
 public:
  /// The stroke, which sets out in `direction`, is begun at `begin`, `offset` from its start [m].
  void restart(const Point& begin, const Point& offset, const Point& direction) noexcept;

  /// The pen is at `tip`; progress counts while it deviates by at most `corridor` [m].
  void update(const Point& tip, const StrokeContact& contact, double length, double corridor) noexcept;

  /// Share of `length` [m] that is covered.
  double share(double length) const noexcept;

  /// Whether the deviation was within a corridor [m] for most of the way.
  bool keeps_to(double corridor) const noexcept;

  /// How far beyond its start the stroke was begun [m].
  double late() const noexcept { return ahead_ > 0.0 ? ahead_ : 0.0; }

 private:
  Point offset_ = Point::Zero();     ///< [m]
  Point tolerated_ = Point::Zero();  ///< what is left of it across the stroke [m]
  Point last_ = Point::Zero();       ///< pen tip [m]
  double furthest_ = 0.0;            ///< arc length, the offset removed [m]
  double covered_ = 0.0;             ///< arc length [m]
  double owed_ = 0.0;                ///< of the corner that was passed [m]
  double way_ = 0.0;                 ///< length of the pen's path [m]
  double squares_ = 0.0;             ///< squared deviation, integrated along it [m^3]
  double ahead_ = 0.0;               ///< offset along the stroke at its beginning [m]
};

}  // namespace calligraphy
