// The arm of a Phantom: joint angles to the tip and back, forces at the tip to torques at the joints.
#pragma once

#include <limits>
#include <string_view>

#include <Eigen/Core>

namespace calligraphy::phantom {

/// Angles of waist, shoulder and elbow [rad]. Shoulder and elbow are both measured against the base, as their motors
/// stand there: the elbow's angle does not change when the shoulder alone turns.
using Joints = Eigen::Vector3d;

struct JointLimits {
  double waist = std::numeric_limits<double>::infinity();            ///< to either side [rad]
  double shoulder_least = -std::numeric_limits<double>::infinity();  ///< [rad]
  double shoulder_most = std::numeric_limits<double>::infinity();    ///< [rad]
  double elbow_least = -1.5707963267948966;  ///< elbow less shoulder; the arm is singular at a right angle [rad]
  double elbow_most = 1.5707963267948966;    ///< [rad]
};

/// An arm of two links on a waist, x right, y up, z to the user:
///
///     r = l1 cos q2 + l2 sin q3
///     p = (s r sin q1, l1 sin q2 - l2 cos q3 + l2, r cos q1 - l1)
///
/// with s the sense of the waist. The tip is at p = 0 when every angle is 0. With s = -1 that is the Omni and the
/// Touch [Ubitrack, uthapticcalibration; Harders et al., Calibration, Registration, and Synchronization for High
/// Precision Augmented Reality Haptics, TVCG 2009], with s = 1 the Premium [the facts in mahilab/Phantom, their axes
/// turned and their origin moved to p = 0].
struct Linkage {
  double upper_arm = 0.0;    ///< l1 [m]
  double forearm = 0.0;      ///< l2 [m]
  double waist_sense = 1.0;  ///< s: 1 or -1
  JointLimits limits;
  /// Where this library puts the origin of the device's axes: the box of the workspace, centred here, stays furthest
  /// from the limits of the joints. Not the vendor's origin. [m]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
};

/// Of a model: omni, touch or premium-1.5. The limits of the first two are published; of the Premium none are, so that
/// only its geometry limits it.
/// @throws ValueError naming the model and those that exist
const Linkage& linkage(std::string_view model);

/// p of the joints. [m]
Eigen::Vector3d tip_position(const Linkage& linkage, const Joints& joints) noexcept;

/// dp/dq. [m/rad]
Eigen::Matrix3d tip_jacobian(const Linkage& linkage, const Joints& joints) noexcept;

struct InverseKinematics {
  Joints joints = Joints::Zero();
  bool reachable = false;  ///< false: the joints lead as near as the arm can reach along the ray from the shoulder
};

/// The joints that put the tip at p [m]; of the two solutions the one with the elbow up, of the waist's two the one in
/// front. The limits of the joints are not asked. A place that is not finite is not reachable, the joints then zero.
InverseKinematics inverse_kinematics(const Linkage& linkage, const Eigen::Vector3d& position) noexcept;

/// Whether each joint keeps its limits to within `margin` [rad].
bool within_limits(const Linkage& linkage, const Joints& joints, double margin = 0.0) noexcept;

/// r cos(q2 - q3) / (l1 + l2): the part of the Jacobian's determinant that vanishes where the arm is singular:
/// stretched or folded, or the tip above the waist. Up to 1.
double dexterity(const Linkage& linkage, const Joints& joints) noexcept;

/// Torques that give this force [N] at the tip, J^T F [N m]. Never more than (l1 + l2) |F| in any joint, at singular
/// joints too: there the arm bears a part of the force that no motor can give.
Eigen::Vector3d joint_torque(const Linkage& linkage, const Joints& joints, const Eigen::Vector3d& force) noexcept;

/// Torques that hold the arm against its weight [N m]. `gravity`: what holds the upper arm when it is level (q2 = 0),
/// and the forearm when it is level (q3 = pi/2), counterweights counted in [N m].
Eigen::Vector3d gravity_torque(const Eigen::Vector2d& gravity, const Joints& joints) noexcept;

}  // namespace calligraphy::phantom
