// The stroke that is being written: its elements, its stack of feature points, and how far the pen has come
// (Wang 2006, sec. 4.3, 4.3.3).
#pragma once

#include <array>

#include <calligraphy/collision/constraint_space.hpp>
#include <calligraphy/collision/detail/feature_plane.hpp>
#include <calligraphy/collision/placed_character.hpp>

namespace calligraphy {

/// When a feature point counts as passed.
enum class FeaturePlaneRule {
  bounded,  ///< its plane is crossed within the constraint space and near the feature point
  wang2006  ///< its plane is crossed anywhere, eq. (6) as printed
};

/// Which attraction factor holds between two feature points.
enum class AttractionRule {
  interpolated,  ///< linear in arc length between them
  wang2006       ///< "at current feature point": the last one passed, so that the force steps at each
};

struct StrokeRules {
  NearestPointOptions nearest = {.method = NearestPointMethod::tracked};
  ConstraintSpace space;
  FeaturePlaneRule plane = FeaturePlaneRule::bounded;
  AttractionRule attraction = AttractionRule::interpolated;
  /// A bounded plane is passed this much before it is reached, at most 0.3 of the element's length [m].
  double plane_tolerance = 0.0015;
  /// The closest point is sought within this arc length of the last one, so that a strong bend, a loop or a limb close
  /// by cannot attract the pen out of turn; 0: on the whole element, as printed [m].
  double window = 0.008;
};

/// Where the pen is with respect to the active stroke.
struct StrokeContact {
  int element = 0;              ///< index of the active element
  NearestPoint closest;         ///< on the active element
  double weight = 0.0;          ///< of the guidance force, 0 outside the constraint space
  double attraction = 1.0;      ///< attraction factor at the closest point
  double arc = 0.0;             ///< arc length of the closest point from the start of the stroke [m]
  double backwards = 0.0;       ///< arc length by which the closest point is behind the furthest one [m]
  bool passed_feature = false;  ///< a feature point was passed in this update
  bool finished = false;        ///< the last feature point has been passed
};

/// Only this stroke is prepared; all other strokes of the page cost nothing. Never allocates.
class ActiveStroke {
 public:
  /// Prepares the stroke and fills its stack of feature points.
  void load(const Stroke& stroke, const Placement& placement) noexcept;

  /// Fills the stack again: the pen was lifted before the end (sec. 4.3).
  void reload() noexcept;

  /// Moves the pen tip to `tip` [m, page]. At most one feature point is passed per call.
  StrokeContact update(const Point& tip, const StrokeRules& rules) noexcept;

  /// Whether a pen at `tip` begins the stroke: within `radius` of its start and not nearer to the next feature point,
  /// so that a short stroke is not over before it was written. [m]
  bool begins_at(const Point& tip, double radius) const noexcept;

  Point start() const noexcept { return elements_[0].origin(); }
  double length() const noexcept { return first_arc_[static_cast<std::size_t>(element_count_)]; }
  /// Feature points still to be passed; 0 once the stroke is finished.
  int features_remaining() const noexcept { return element_count_ - active_; }
  const StrokeElement& element(int index) const noexcept { return elements_[static_cast<std::size_t>(index)]; }
  int element_count() const noexcept { return element_count_; }

 private:
  StrokeContact locate(const Point& tip, const StrokeRules& rules) const noexcept;
  bool passes(const Point& tip, const StrokeContact& contact, const StrokeRules& rules) const noexcept;

  std::array<StrokeElement, max_elements_per_stroke> elements_;
  std::array<FeaturePlane, max_elements_per_stroke> planes_;
  std::array<double, max_elements_per_stroke + 1> attraction_ = {};  ///< per feature point
  std::array<double, max_elements_per_stroke + 1> first_arc_ = {};   ///< arc length at each feature point
  int element_count_ = 0;
  int active_ = 0;          ///< element being written; element_count_ once finished
  double arc_ = 0.0;        ///< of the last closest point, within the active element
  double parameter_ = 0.0;  ///< of the last closest point
  double furthest_ = 0.0;   ///< from the start of the stroke
};

}  // namespace calligraphy
