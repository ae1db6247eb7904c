// Maps device axes to the page and back (Wang 2006, sec. 4.2, eq. (2)-(5)).
#pragma once

#include <Eigen/Core>

namespace calligraphy {

/// Rigid transform between the device axes and the page axes, with the motion scale K_S. Page frame: origin at the
/// lower left corner, x right, y up, z out of the paper [m].
///
/// With K_S constant, eq. (2) and (3) integrate to this map of positions, which neither drifts nor depends on the rate.
struct MotionMapping {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< from device axes to page axes
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();        ///< position of the device origin on the page [m]
  double scale = 1.0;  ///< K_S: how far the pen moves on the page for each metre of the device [1]

  /// Position in device axes [m] to position on the page [m], eq. (3).
  Eigen::Vector3d to_page(const Eigen::Vector3d& device) const noexcept {
    return offset + scale * turned(rotation, device);
  }
  /// Velocity in device axes [m/s] to velocity on the page [m/s].
  Eigen::Vector3d velocity_to_page(const Eigen::Vector3d& device) const noexcept {
    return scale * turned(rotation, device);
  }
  /// Position on the page [m] to position in device axes [m]: the inverse of to_page().
  Eigen::Vector3d to_device(const Eigen::Vector3d& page) const noexcept {
    return turned(rotation.transpose(), page - offset) / scale;
  }
  /// Force on the pen, page axes [N], to the force of the device [N]. Preserves power: force times velocity is the same
  /// on both sides.
  Eigen::Vector3d force_to_device(const Eigen::Vector3d& page) const noexcept {
    return scale * turned(rotation.transpose(), page);
  }
  /// Force of the device [N] to force on the pen, page axes [N]: the inverse of force_to_device().
  Eigen::Vector3d force_to_page(const Eigen::Vector3d& device) const noexcept {
    return turned(rotation, device) / scale;
  }

 private:
  /// Column by column: Eigen's own product adds in an order that depends on the processor, and fuses on some.
  static Eigen::Vector3d turned(const Eigen::Matrix3d& by, const Eigen::Vector3d& vector) noexcept {
    return by.col(0) * vector.x() + by.col(1) * vector.y() + by.col(2) * vector.z();
  }
};

/// Checks a mapping. @throws ValueError naming what is wrong: not a rotation, an offset that is not finite, a scale
/// outside [1e-6, 1e6]
void validate(const MotionMapping& mapping);

/// Upright page [m] in the x-y plane of the device, as in the paper's experiments (sec. 7.2). The centre of the page
/// lies at the device origin for every scale K_S; with K_S = 2 the pen on the page moves twice as far as the device. An
/// invalid scale is rejected where the mapping is used (HapticRenderer).
MotionMapping upright_page(double width, double height, double scale = 1.0);

/// Page flat on the desk: page y points away from the user (-z of the device), page z up. Otherwise as upright_page().
MotionMapping desk_page(double width, double height, double scale = 1.0);

}  // namespace calligraphy
