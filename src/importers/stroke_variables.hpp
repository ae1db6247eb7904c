// The variables of a fit: the control points of a stroke, constrained by smooth joints; private to the importers.
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include <calligraphy/model/typical_stroke.hpp>

#include "polyline.hpp"

namespace calligraphy::recognition {

/// At a smooth joint, the handle of one curve lies on the tangent of the adjacent element: handle = joint + a (joint -
/// fixed), where a > 0 is the only variable.
class StrokeVariables {
 public:
  explicit StrokeVariables(const TypicalStroke& type);

  Eigen::VectorXd values_of(std::span<const Point> control_points) const;
  std::vector<Point> control_points_of(const Eigen::VectorXd& values) const;
  /// Derivative of all coordinates (x, y of the first control point, of the second ...) with respect to the variables.
  Eigen::MatrixXd slopes_at(std::span<const Point> control_points) const;
  /// True without smooth joints: the variables are the coordinates.
  bool plain() const { return handles_.empty(); }

 private:
  struct Handle {
    int at, joint, fixed;  ///< indices of control points
  };
  bool is_handle(int point) const;

  std::vector<Handle> handles_;
  std::vector<int> first_variable_;  ///< of each control point
  int points_;
  int variables_;
};

}  // namespace calligraphy::recognition
