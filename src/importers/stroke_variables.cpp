#include "stroke_variables.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace calligraphy::recognition {
namespace {

/// Bounds of the length of a handle, relative to the distance from the joint to the fixed point: not zero, where the
/// curve would have no direction, and not long enough to create a loop.
constexpr double min_handle = 0.02;
constexpr double max_handle = 8.0;

}  // namespace

StrokeVariables::StrokeVariables(const TypicalStroke& type) : points_(type.control_point_count()) {
  const std::string_view elements = type.elements;
  const std::vector<int> joints = type.feature_points();
  for (std::size_t joint = 1; joint < elements.size(); ++joint) {
    if (type.joints[joint - 1] != 's') continue;
    const int at = joints[joint];
    const bool leaves_curve = elements[joint] == 'C';
    handles_.push_back({leaves_curve ? at + 1 : at - 1, at, leaves_curve ? at - 1 : at + 1});
  }
  variables_ = 0;
  for (int point = 0; point < points_; ++point) {
    first_variable_.push_back(variables_);
    variables_ += is_handle(point) ? 1 : 2;
  }
}

bool StrokeVariables::is_handle(int point) const {
  return std::any_of(handles_.begin(), handles_.end(), [&](const Handle& handle) { return handle.at == point; });
}

Eigen::VectorXd StrokeVariables::values_of(std::span<const Point> control_points) const {
  Eigen::VectorXd values(variables_);
  for (int point = 0; point < points_; ++point) {
    const int first = first_variable_[point];
    if (first + 1 < (point + 1 < points_ ? first_variable_[point + 1] : variables_)) {
      values.segment<2>(first) = control_points[point];
    }
  }
  for (const Handle& handle : handles_) {
    const Point away = control_points[handle.joint] - control_points[handle.fixed];
    const double along = (control_points[handle.at] - control_points[handle.joint]).dot(away);
    values[first_variable_[handle.at]] = along / std::max(away.squaredNorm(), 1e-12);
  }
  return values;
}

std::vector<Point> StrokeVariables::control_points_of(const Eigen::VectorXd& values) const {
  std::vector<Point> points(static_cast<std::size_t>(points_));
  for (int point = 0; point < points_; ++point) {
    const int first = first_variable_[point];
    points[point] = values.segment<2>(std::min(first, variables_ - 2));
  }
  for (const Handle& handle : handles_) {
    const double reach = std::clamp(values[first_variable_[handle.at]], min_handle, max_handle);
    points[handle.at] = points[handle.joint] + reach * (points[handle.joint] - points[handle.fixed]);
  }
  return points;
}

Eigen::MatrixXd StrokeVariables::slopes_at(std::span<const Point> control_points) const {
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(2 * points_, variables_);
  for (int point = 0; point < points_; ++point) {
    const int first = first_variable_[point];
    if (!is_handle(point)) {
      slopes.block<2, 2>(2 * point, first).setIdentity();
    }
  }
  for (const Handle& handle : handles_) {
    const Point away = control_points[handle.joint] - control_points[handle.fixed];
    const double reach =
        (control_points[handle.at] - control_points[handle.joint]).dot(away) / std::max(away.squaredNorm(), 1e-12);
    slopes.block<2, 2>(2 * handle.at, first_variable_[handle.joint]).diagonal().setConstant(1.0 + reach);
    slopes.block<2, 2>(2 * handle.at, first_variable_[handle.fixed]).diagonal().setConstant(-reach);
    slopes.block<2, 1>(2 * handle.at, first_variable_[handle.at]) = away;
  }
  return slopes;
}

}  // namespace calligraphy::recognition
