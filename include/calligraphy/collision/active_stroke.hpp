// The stroke being written: its elements, its stack of feature points and the progress of the pen
// (Wang 2006, sec. 4.3, 4.3.3).
#pragma once

#include <vector>

#include <calligraphy/collision/constraint_space.hpp>
#include <calligraphy/collision/detail/feature_plane.hpp>
#include <calligraphy/model/placed_character.hpp>

namespace calligraphy {

/// How a pen is tracked along a stroke.
struct StrokeOptions {
  NearestPointOptions nearest = {.method = NearestPointMethod::tracked};  ///< method and accuracy of the nearest point
  ConstraintSpace space = {};                                             ///< where the stroke attracts the pen
  Rules rules = Rules::revised;  ///< rules of feature planes, attraction and constraint space
};

/// Position of the pen relative to the active stroke.
struct StrokeContact {
  int element = 0;              ///< index of the active element
  NearestPoint closest;         ///< on the active element
  double weight = 0.0;          ///< weight of the guidance force; 0 outside the constraint space
  double attraction = 1.0;      ///< attraction factor at the closest point
  double arc = 0.0;             ///< arc length of the closest point from the start of the stroke [m]
  double backwards = 0.0;       ///< arc length of the closest point behind the furthest one reached [m]
  bool passed_feature = false;  ///< whether this update passed a feature point
  bool finished = false;        ///< whether the last feature point has been passed
};

/// A place on a stroke.
struct StrokePlace {
  Point point = Point::Zero();    ///< [m, page]
  Point tangent = Point::Zero();  ///< unit vector in writing direction; zero if the stroke is a point
  double curvature = 0.0;         ///< positive where the stroke bends to the left: StrokeElement::curvature() [1/m]
};

/// One stroke of a page; the others take no time. Call load() first; nothing else allocates.
class ActiveStroke {
 public:
  /// Prepares the stroke and fills its stack of feature points. Takes some microseconds.
  void load(const Stroke& stroke, const Placement& placement);

  /// Refills the stack of feature points after the pen was lifted before the end (sec. 4.3).
  void reload() noexcept;

  /// Refills the stack for a pen put down at `tip` [m, page]. A writer who begins beside the start may turn equally far
  /// from each feature point.
  void begin(const Point& tip) noexcept;

  /// Tracks a pen put down where nearest() found it, although the part of the stroke before was not written.
  void rest(const StrokeContact& nearest) noexcept;

  /// Tracks the pen tip at `tip` [m, page]. At most one feature point is passed per call.
  StrokeContact update(const Point& tip, const StrokeOptions& options) noexcept;

  /// Position of a pen at `tip` [m, page] that is not writing the stroke: the nearest point on the whole stroke,
  /// without effect on its progress and without an attraction factor.
  StrokeContact nearest(const Point& tip, const StrokeOptions& options) const noexcept;

  /// The place at an arc length from the start [m], clamped to the stroke (NaN counts as 0). At a corner it is the end
  /// of the element before. Does not allocate.
  StrokePlace at(double arc) const noexcept;

  /// First point of the stroke [m, page].
  const Point& start() const noexcept { return start_; }
  /// Last point of the stroke [m, page].
  Point end() const noexcept { return parts_.back().end.point; }
  /// Attraction factor at the start.
  double first_attraction() const noexcept { return parts_.front().first_attraction; }
  /// Arc length of the whole stroke [m].
  double length() const noexcept { return parts_.back().last_arc; }
  /// The element with this index, in writing order.
  const StrokeElement& element(int index) const noexcept { return parts_[static_cast<std::size_t>(index)].element; }
  /// Number of elements; 0 before load().
  int element_count() const noexcept { return static_cast<int>(parts_.size()); }

 private:
  /// The stroke from one feature point to the next.
  struct Part {
    StrokeElement element;
    detail::FeaturePlane end;
    double first_arc, last_arc;  ///< arc length from the start of the stroke [m]
    double first_attraction, last_attraction;
  };

  const Part& part(int index) const noexcept { return parts_[static_cast<std::size_t>(index)]; }
  bool is_finished() const noexcept { return active_ == element_count(); }
  StrokeContact locate(const Point& tip, const StrokeOptions& options) const noexcept;
  void pass_feature(const Point& tip, const StrokeOptions& options, StrokeContact& contact) noexcept;
  bool passes(const Point& tip, const StrokeContact& contact, const StrokeOptions& options) const noexcept;

  std::vector<Part> parts_;
  double em_ = 0.0;                     ///< [m]
  Point start_ = Point::Zero();         ///< of the first element, of which a tick may need nothing else [m]
  Point start_offset_ = Point::Zero();  ///< from the start of the stroke to where the pen began [m]
  int active_ = 0;                      ///< element being written; element_count() once finished
  double arc_ = 0.0;                    ///< arc length of the last closest point, within the active element
  double parameter_ = 0.0;              ///< of the last closest point
  double furthest_ = 0.0;               ///< arc length from the start of the stroke
};

}  // namespace calligraphy
