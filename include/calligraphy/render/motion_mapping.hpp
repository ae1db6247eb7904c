// Maps device axes to the page and back (Wang 2006, sec. 4.2, eq. (2)-(5)).
#pragma once

#include <Eigen/Core>

namespace calligraphy {

/// Rigid transform between the device axes and the page axes, with the motion scale K_S. Page frame: origin at the
/// lower left corner, x right, y up, z out of the paper [m].
///
/// With K_S constant, eq. (2) and (3) integrate to this map of positions, which neither drifts nor depends on the rate.
struct MotionMapping {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< device axes to page axes
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();        ///< position of the device origin on the page [m]
  double scale = 1.0;                                      ///< K_S

  Eigen::Vector3d to_page(const Eigen::Vector3d& device) const noexcept {
    return offset + scale * turned(rotation, device);
  }
  Eigen::Vector3d velocity_to_page(const Eigen::Vector3d& device) const noexcept {
    return scale * turned(rotation, device);
  }
  Eigen::Vector3d to_device(const Eigen::Vector3d& page) const noexcept {
    return turned(rotation.transpose(), page - offset) / scale;
  }
  /// Preserves power: force times velocity is the same on both sides.
  Eigen::Vector3d force_to_device(const Eigen::Vector3d& page) const noexcept {
    return scale * turned(rotation.transpose(), page);
  }
  Eigen::Vector3d force_to_page(const Eigen::Vector3d& device) const noexcept {
    return turned(rotation, device) / scale;
  }

 private:
  /// Column by column: Eigen's own product adds in an order that depends on the processor, and fuses on some.
  static Eigen::Vector3d turned(const Eigen::Matrix3d& by, const Eigen::Vector3d& vector) noexcept {
    return by.col(0) * vector.x() + by.col(1) * vector.y() + by.col(2) * vector.z();
  }
};

/// @throws ValueError naming what is wrong: not a rotation, an offset that is not finite, a scale outside [1e-6, 1e6]
void validate(const MotionMapping& mapping);

/// Upright page [m] in the x-y plane of the device, as in the paper's experiments (sec. 7.2). The centre of the page
/// lies at the device origin for every scale K_S; with K_S = 2 the pen on the page moves twice as far as the device. A
/// wrong scale is refused by what uses the mapping (HapticRenderer).
MotionMapping upright_page(double width, double height, double scale = 1.0);

/// Page flat on the desk: page y points away from the user (-z of the device), page z up. Otherwise as upright_page().
MotionMapping desk_page(double width, double height, double scale = 1.0);

}  // namespace calligraphy
