// Kinematics of a Phantom's arm: joint angles to tip position and back, forces at the tip to joint torques.
#pragma once

#include <limits>
#include <string_view>

#include <Eigen/Core>

/// Kinematics and wire profiles of Phantom devices.
namespace calligraphy::phantom {

/// Angles of waist, shoulder and elbow [rad]. Shoulder and elbow are both measured relative to the base, where their
/// motors are mounted: turning the shoulder alone does not change the elbow angle.
using Joints = Eigen::Vector3d;

/// Joint limits of an arm.
struct JointLimits {
  double waist = std::numeric_limits<double>::infinity();          ///< largest waist angle, in both directions [rad]
  double shoulder_min = -std::numeric_limits<double>::infinity();  ///< lowest shoulder angle [rad]
  double shoulder_max = std::numeric_limits<double>::infinity();   ///< highest shoulder angle [rad]
  double elbow_min = -1.5707963267948966;  ///< lowest elbow minus shoulder; the arm is singular at a right angle [rad]
  double elbow_max = 1.5707963267948966;   ///< highest elbow minus shoulder, likewise [rad]
};

/// An arm of two links on a waist joint; x right, y up, z towards the user:
///
///     r = l1 cos q2 + l2 sin q3
///     p = (s r sin q1, l1 sin q2 - l2 cos q3 + l2, r cos q1 - l1)
///
/// with s the sense of the waist. All angles are 0 at p = 0. s = -1 gives the Omni and the Touch [Ubitrack,
/// uthapticcalibration; Harders et al., Calibration, Registration, and Synchronization for High Precision Augmented
/// Reality Haptics, TVCG 2009], s = 1 the Premium [facts from mahilab/Phantom, with the axes rotated and the origin
/// moved to p = 0].
struct Linkage {
  double upper_arm = 0.0;    ///< length l1 [m]
  double forearm = 0.0;      ///< length l2 [m]
  double waist_sense = 1.0;  ///< s: 1 or -1
  JointLimits limits;        ///< limits of its joints
  /// Origin of the device axes in this library, chosen so that the workspace box centred on it stays as far as possible
  /// from the joint limits. Not the vendor's origin. [m]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
};

/// The linkage of a model: omni, touch or premium-1.5. Joint limits are published for the first two only, so the
/// Premium is limited by its geometry alone.
/// @throws ValueError naming the unknown model and the available ones
const Linkage& linkage(std::string_view model);

/// Forward kinematics p(q), relative to the origin of the formulas above [m].
Eigen::Vector3d tip_position(const Linkage& linkage, const Joints& joints) noexcept;

/// Jacobian dp/dq [m/rad].
Eigen::Matrix3d tip_jacobian(const Linkage& linkage, const Joints& joints) noexcept;

/// The pose with the tip at a position.
struct InverseKinematics {
  Joints joints = Joints::Zero();  ///< angles of waist, shoulder and elbow [rad]
  bool reachable = false;          ///< if false, the joints give the nearest pose along the ray from the shoulder
};

/// Joint angles that put the tip at p [m], with the elbow up and the tip in front of the waist. Joint limits are not
/// checked. A position that is not finite is unreachable, with all angles zero.
InverseKinematics inverse_kinematics(const Linkage& linkage, const Eigen::Vector3d& position) noexcept;

/// Whether every joint is within its limits, extended by `margin` [rad].
bool within_limits(const Linkage& linkage, const Joints& joints, double margin = 0.0) noexcept;

/// r cos(q2 - q3) / (l1 + l2): the factor of the Jacobian's determinant that vanishes in singular poses (stretched,
/// folded, or the tip above the waist). At most 1 in magnitude.
double manipulability(const Linkage& linkage, const Joints& joints) noexcept;

/// Joint torques J^T F [N m] for the force F [N] at the tip. At most (l1 + l2) |F| in each joint, even in singular
/// poses, where the linkage itself supports the force components that no motor can exert.
Eigen::Vector3d joint_torque(const Linkage& linkage, const Joints& joints, const Eigen::Vector3d& force) noexcept;

/// Joint torques that compensate the weight of the arm [N m]. `gravity`: torques that hold the level upper arm (q2 = 0)
/// and the level forearm (q3 = pi/2), counterweights included [N m].
Eigen::Vector3d gravity_torque(const Eigen::Vector2d& gravity, const Joints& joints) noexcept;

}  // namespace calligraphy::phantom
