#include <calligraphy/devices/phantom/kinematics.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <calligraphy/base/error.hpp>

namespace calligraphy::phantom {
namespace {

Linkage omni() {
  Linkage linkage;
  linkage.upper_arm = 0.13335;
  linkage.forearm = 0.13335;
  linkage.waist_sense = -1.0;
  linkage.limits = {0.98, 0.0, 1.75, -0.81, 1.25};
  linkage.centre = {0.0, 0.160, 0.050};  // 160 x 120 x 70 mm around it stays 0.35 rad away from every limit
  return linkage;
}

Linkage premium() {
  Linkage linkage;
  linkage.upper_arm = 0.20955;
  linkage.forearm = 0.169545;
  linkage.waist_sense = 1.0;
  linkage.limits.waist = std::numbers::pi / 2.0;
  linkage.centre = {0.0, 0.170, -0.010};  // 381 x 267 x 191 mm around it stays farthest from singularities
  return linkage;
}

/// Cosine of the angle between sides a and b of a triangle, opposite side c; beyond 1 if there is no such triangle.
double cosine(double a, double b, double c) noexcept { return (a * a + b * b - c * c) / (2.0 * a * b); }

}  // namespace

const Linkage& linkage(std::string_view model) {
  static const Linkage of_omni = omni(), of_premium = premium();
  if (model == "omni" || model == "touch") return of_omni;
  if (model == "premium-1.5") return of_premium;
  throw ValueError("linkage \"" + std::string(model) + "\" does not exist; available: omni, touch, premium-1.5");
}

Eigen::Vector3d tip_position(const Linkage& linkage, const Joints& joints) noexcept {
  const double l1 = linkage.upper_arm, l2 = linkage.forearm;
  const double r = l1 * std::cos(joints[1]) + l2 * std::sin(joints[2]);
  return {linkage.waist_sense * r * std::sin(joints[0]), l1 * std::sin(joints[1]) - l2 * std::cos(joints[2]) + l2,
          r * std::cos(joints[0]) - l1};
}

Eigen::Matrix3d tip_jacobian(const Linkage& linkage, const Joints& joints) noexcept {
  const double l1 = linkage.upper_arm, l2 = linkage.forearm, sense = linkage.waist_sense;
  const double s1 = std::sin(joints[0]), c1 = std::cos(joints[0]);
  const double s2 = std::sin(joints[1]), c2 = std::cos(joints[1]);
  const double s3 = std::sin(joints[2]), c3 = std::cos(joints[2]);
  const double r = l1 * c2 + l2 * s3;
  Eigen::Matrix3d jacobian;
  jacobian << sense * r * c1, -sense * l1 * s2 * s1, sense * l2 * c3 * s1,  //
      0.0, l1 * c2, l2 * s3,                                                //
      -r * s1, -l1 * s2 * c1, l2 * c3 * c1;
  return jacobian;
}

InverseKinematics inverse_kinematics(const Linkage& linkage, const Eigen::Vector3d& position) noexcept {
  InverseKinematics result;
  if (!position.allFinite()) return result;
  const double l1 = linkage.upper_arm, l2 = linkage.forearm;
  const double forward = position.z() + l1, up = position.y() - l2;
  const double radius = std::hypot(position.x(), forward);
  const double whole = std::hypot(radius, up);
  // The limits are the folded and the stretched arm. Ten ulps of slack keep the boundary itself reachable.
  const double least = std::abs(l1 - l2), most = l1 + l2;
  const double slack = 10.0 * std::numeric_limits<double>::epsilon() * most;
  if (!(l1 > 0.0 && l2 > 0.0)) return result;  // no arm
  result.reachable = whole >= least - slack && whole <= most + slack;
  const double length = std::clamp(whole, std::max(least, 1e-12 * most), most);
  const double at_shoulder = std::clamp(cosine(l1, length, l2), -1.0, 1.0);
  const double at_elbow = std::clamp(cosine(l1, l2, length), -1.0, 1.0);
  result.joints[0] = std::atan2(linkage.waist_sense * position.x(), forward);
  result.joints[1] = std::acos(at_shoulder) + std::atan2(up, radius);
  result.joints[2] = result.joints[1] + std::acos(at_elbow) - std::numbers::pi / 2.0;
  return result;
}

bool within_limits(const Linkage& linkage, const Joints& joints, double margin) noexcept {
  const JointLimits& limits = linkage.limits;
  const double elbow = joints[2] - joints[1];
  return std::abs(joints[0]) <= limits.waist + margin && joints[1] >= limits.shoulder_min - margin &&
         joints[1] <= limits.shoulder_max + margin && elbow >= limits.elbow_min - margin &&
         elbow <= limits.elbow_max + margin;
}

double manipulability(const Linkage& linkage, const Joints& joints) noexcept {
  const double r = linkage.upper_arm * std::cos(joints[1]) + linkage.forearm * std::sin(joints[2]);
  return r * std::cos(joints[1] - joints[2]) / (linkage.upper_arm + linkage.forearm);
}

Eigen::Vector3d joint_torque(const Linkage& linkage, const Joints& joints, const Eigen::Vector3d& force) noexcept {
  return tip_jacobian(linkage, joints).transpose() * force;
}

Eigen::Vector3d gravity_torque(const Eigen::Vector2d& gravity, const Joints& joints) noexcept {
  return {0.0, gravity[0] * std::cos(joints[1]), gravity[1] * std::sin(joints[2])};
}

}  // namespace calligraphy::phantom
