// What may move when a stroke is fitted: its control points, without what smooth joints take away; private to the
// model.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include <calligraphy/model/typical_stroke.hpp>

#include "polyline.hpp"

namespace calligraphy::recognition {

/// At a joint that its typical stroke calls smooth the handle of one curve lies on the tangent of the element beside
/// it: handle = joint + a (joint - fixed), where a > 0 is the only thing left to choose.
class StrokeVariables {
 public:
  explicit StrokeVariables(const TypicalStroke& type);

  Eigen::VectorXd values_of(std::span<const Point> control_points) const;
  std::vector<Point> control_points_of(const Eigen::VectorXd& values) const;
  /// Derivative of all coordinates (x, y of the first control point, of the second ...) after the variables.
  Eigen::MatrixXd slopes_at(std::span<const Point> control_points) const;
  /// No smooth joint: the variables are the coordinates.
  bool plain() const { return handles_.empty(); }

 private:
  struct Handle {
    int at, joint, fixed;  ///< indices of control points
  };
  std::vector<Handle> handles_;
  std::vector<int> first_variable_;  ///< of each control point
  int points_;
  int variables_;
};

}  // namespace calligraphy::recognition
