// From device axes to the page and back (Wang 2006, sec. 4.2, eq. (2)-(5)).
#pragma once

#include <Eigen/Core>

namespace calligraphy {

/// Rigid transform between the device's axes and the page, with the motion scale K_S. Page frame: origin at the lower
/// left corner, x right, y up, z out of the paper [m].
///
/// With K_S constant, eq. (2) and (3) integrate to this map of position; it neither drifts nor depends on the rate.
struct MotionMapping {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< device axes to page axes
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();        ///< where the device's zero is on the page [m]
  double scale = 1.0;                                      ///< K_S

  Eigen::Vector3d to_page(const Eigen::Vector3d& device) const noexcept { return offset + scale * (rotation * device); }
  Eigen::Vector3d velocity_to_page(const Eigen::Vector3d& device) const noexcept { return scale * (rotation * device); }
  Eigen::Vector3d to_device(const Eigen::Vector3d& page) const noexcept {
    return rotation.transpose() * (page - offset) / scale;
  }
  /// Keeps power: force times velocity is the same on both sides.
  Eigen::Vector3d force_to_device(const Eigen::Vector3d& page) const noexcept {
    return scale * (rotation.transpose() * page);
  }
};

/// Page upright in the device's x-y plane, as in the paper's experiments (sec. 7.2), its centre at the device's zero.
MotionMapping upright_page(double width, double height);

/// Page flat on the desk: page y is away from the user (-z of the device), out of the paper is up.
MotionMapping desk_page(double width, double height);

enum class MotionMappingRule {
  affine,   ///< MotionMapping::to_page
  wang2006  ///< eq. (3) as printed: the velocity is integrated tick by tick, starting from the first position
};

}  // namespace calligraphy
