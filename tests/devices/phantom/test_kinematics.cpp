#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <Eigen/LU>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/random.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/devices/phantom/kinematics.hpp>
#include <calligraphy/devices/simulated_device.hpp>

#include "../../catch.hpp"

using namespace calligraphy;
using namespace calligraphy::phantom;

namespace {

constexpr double pi = std::numbers::pi;

/// Within the limits of the Omni, and of the Premium as well.
Joints random_joints(Random& random) {
  const double shoulder = random.between(0.0, 1.75);
  return {random.between(-0.98, 0.98), shoulder, shoulder + random.between(-0.81, 1.25)};
}

}  // namespace

TEST_CASE("an arm without lengths reaches nothing", "[phantom][kinematics]") {
  for (const double upper_arm : {0.0, 0.1, -0.1}) {
    Linkage linkage;
    linkage.upper_arm = upper_arm;
    const InverseKinematics found = inverse_kinematics(linkage, Eigen::Vector3d::Zero());
    CHECK(!found.reachable);
    CHECK(found.joints.allFinite());
  }
}

TEST_CASE("the tip is at zero when all joints are, and moves according to the published formulas",
          "[phantom][kinematics]") {
  const Linkage& omni = linkage("omni");
  CHECK(tip_position(omni, Joints::Zero()).norm() == 0.0);
  CHECK(tip_position(linkage("premium-1.5"), Joints::Zero()).norm() == 0.0);
  CHECK(&linkage("touch") == &omni);
  const double l = 0.13335;
  // Waist turned by a right angle: the arm, which reached l towards the user, now reaches l to the left.
  CHECK((tip_position(omni, {pi / 2.0, 0.0, 0.0}) - Eigen::Vector3d(-l, 0.0, -l)).norm() < 1e-15);
  // Upper arm vertical, forearm hanging down: above the waist.
  CHECK((tip_position(omni, {0.0, pi / 2.0, 0.0}) - Eigen::Vector3d(0.0, l, -l)).norm() < 1e-15);
  // Forearm level as well as the upper arm.
  CHECK((tip_position(omni, {0.0, 0.0, pi / 2.0}) - Eigen::Vector3d(0.0, l, l)).norm() < 1e-15);
  const double l1 = 0.20955, l2 = 0.169545;
  const Joints joints(0.3, 0.5, 0.7);
  const double r = l1 * std::cos(0.5) + l2 * std::sin(0.7);
  const Eigen::Vector3d premium(std::sin(0.3) * r, l1 * std::sin(0.5) - l2 * std::cos(0.7) + l2,
                                std::cos(0.3) * r - l1);
  CHECK((tip_position(linkage("premium-1.5"), joints) - premium).norm() < 1e-15);
  CHECK_THROWS_WITH(linkage("falcon"), Catch::Matchers::Contains("\"falcon\"") && Catch::Matchers::Contains("omni"));
}

TEST_CASE("the Jacobian is the derivative of the tip", "[phantom][kinematics]") {
  for (const std::string model : {"omni", "premium-1.5"}) {
    const Linkage& arm = linkage(model);
    Random random(1);
    for (int i = 0; i < 500; ++i) {
      const Joints joints = random_joints(random);
      const Eigen::Matrix3d jacobian = tip_jacobian(arm, joints);
      for (Eigen::Index joint = 0; joint < 3; ++joint) {
        constexpr double step = 1e-5;
        const Joints turn = step * Joints::Unit(joint);
        const Eigen::Vector3d slope =
            (tip_position(arm, joints + turn) - tip_position(arm, joints - turn)) / (2.0 * step);
        REQUIRE((jacobian.col(joint) - slope).norm() < 5e-11);
      }
    }
  }
}

TEST_CASE("inverse kinematics recovers the joint angles", "[phantom][kinematics]") {
  for (const std::string model : {"omni", "premium-1.5"}) {
    const Linkage& arm = linkage(model);
    Random random(2);
    for (int i = 0; i < 2000; ++i) {
      const Joints joints = random_joints(random);
      // Bent all the way back, the arm has its tip behind the waist: the inverse gives the other solution for it.
      if (arm.upper_arm * std::cos(joints[1]) + arm.forearm * std::sin(joints[2]) < 0.01) continue;
      const InverseKinematics inverse = inverse_kinematics(arm, tip_position(arm, joints));
      REQUIRE(inverse.reachable);
      // The reference found 3e-15 with the arm of the Omni; rounding errors are amplified near the folded pose.
      REQUIRE((inverse.joints - joints).cwiseAbs().maxCoeff() < 1e-14);
    }
  }
}

TEST_CASE("an unreachable position is reported, with the nearest pose of the arm", "[phantom][kinematics]") {
  const Linkage& omni = linkage("omni");
  const Eigen::Vector3d shoulder(0.0, 0.13335, -0.13335);
  Random random(3);
  const auto coordinate = [&] { return random.between(-1.0, 1.0); };
  for (int i = 0; i < 500; ++i) {
    Eigen::Vector3d ray{coordinate(), coordinate(), coordinate()};
    ray.normalize();
    const InverseKinematics far = inverse_kinematics(omni, shoulder + 0.3 * ray);
    REQUIRE_FALSE(far.reachable);
    REQUIRE((tip_position(omni, far.joints) - (shoulder + 0.2667 * ray)).norm() < 1e-8);
    REQUIRE(inverse_kinematics(omni, shoulder + 0.2666 * ray).reachable);
  }
  const Linkage& premium = linkage("premium-1.5");
  CHECK_FALSE(inverse_kinematics(premium, {0.0, 0.169545, -0.20955}).reachable);  // too close: unequal links
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(inverse_kinematics(omni, {0.0, nan, 0.0}).reachable);
  CHECK(inverse_kinematics(omni, {0.0, nan, 0.0}).joints == Joints::Zero());
  CHECK(inverse_kinematics(omni, shoulder).joints.allFinite());
  CHECK(inverse_kinematics(omni, {1e300, -1e300, 1e300}).joints.allFinite());
}

TEST_CASE("the arm is singular when stretched, folded or above the waist, and only there", "[phantom][kinematics]") {
  for (const std::string model : {"omni", "premium-1.5"}) {
    const Linkage& arm = linkage(model);
    const double l1 = arm.upper_arm, l2 = arm.forearm;
    Random random(4);
    for (int i = 0; i < 500; ++i) {
      const Joints joints = random_joints(random);
      const double r = l1 * std::cos(joints[1]) + l2 * std::sin(joints[2]);
      // In the plane of the arm, with the waist at 0: |d(y, z)/d(q2, q3)| = +- l1 l2 cos(q2 - q3).
      const Eigen::Matrix2d plane = tip_jacobian(arm, {0.0, joints[1], joints[2]}).bottomRightCorner<2, 2>();
      const double planar = l1 * l2 * std::cos(joints[1] - joints[2]);
      REQUIRE(std::abs(plane.determinant()) == Approx(std::abs(planar)).epsilon(1e-12));
      REQUIRE(std::abs(tip_jacobian(arm, joints).determinant()) == Approx(std::abs(r * planar)).epsilon(1e-10));
      REQUIRE(manipulability(arm, joints) == Approx(r * planar / (l1 * l2 * (l1 + l2))).epsilon(1e-12));
    }
    CHECK(std::abs(manipulability(arm, {0.2, 0.4, 0.4 + pi / 2.0})) < 1e-15);
    CHECK(std::abs(manipulability(arm, {0.2, 0.4, 0.4 - pi / 2.0})) < 1e-15);
    CHECK(manipulability(arm, {0.2, 0.0, pi / 2.0 - 0.1}) > 0.05);
  }
}

TEST_CASE("torque does the work of the force and stays bounded in singular poses", "[phantom][kinematics]") {
  const Linkage& omni = linkage("omni");
  Random random(5);
  const auto any = [&] { return random.between(-4.0, 4.0); };
  for (int i = 0; i < 2000; ++i) {
    // Arbitrary poses, every fourth one singular.
    Joints joints{any(), any(), any()};
    if (i % 4 == 0) joints[2] = joints[1] + pi / 2.0;
    const Eigen::Vector3d force{any(), any(), any()};
    const Joints velocity{any(), any(), any()};
    const Eigen::Vector3d torque = joint_torque(omni, joints, force);
    const double work = force.dot(tip_jacobian(omni, joints) * velocity);
    REQUIRE(torque.dot(velocity) == Approx(work).margin(1e-12));
    REQUIRE(torque.cwiseAbs().maxCoeff() <= (omni.upper_arm + omni.forearm) * force.norm() * (1.0 + 1e-12));
  }
}

TEST_CASE("the workspace of each model lies within its joint limits", "[phantom][kinematics]") {
  for (const std::string model : {"omni", "touch", "premium-1.5"}) {
    const Linkage& arm = linkage(model);
    const Eigen::Vector3d half = device_profile(model).workspace / 2.0;
    for (int i = 0; i < 5 * 5 * 5; ++i) {
      const Eigen::Vector3d part(i % 5 / 2.0 - 1.0, i / 5 % 5 / 2.0 - 1.0, i / 25 / 2.0 - 1.0);
      const InverseKinematics inverse = inverse_kinematics(arm, arm.centre + part.cwiseProduct(half));
      CAPTURE(model, part.transpose());
      REQUIRE(inverse.reachable);
      REQUIRE(within_limits(arm, inverse.joints, model == "premium-1.5" ? -0.01 : -0.34));
    }
  }
}

TEST_CASE("each joint limit is checked on both sides", "[phantom][kinematics]") {
  const Linkage& omni = linkage("omni");
  const auto within = [&](double waist, double shoulder, double elbow_less_shoulder) {
    return within_limits(omni, {waist, shoulder, shoulder + elbow_less_shoulder});
  };
  CHECK(within(0.979, 0.001, 0.0));
  CHECK_FALSE(within(0.981, 1.0, 0.0));
  CHECK_FALSE(within(-0.981, 1.0, 0.0));
  CHECK_FALSE(within(0.0, -0.001, 0.0));
  CHECK_FALSE(within(0.0, 1.751, 0.0));
  CHECK_FALSE(within(0.0, 1.0, 1.251));
  CHECK_FALSE(within(0.0, 1.0, -0.811));
  CHECK(within_limits(omni, {1.0, -0.05, -0.05}, 0.1));
  CHECK_FALSE(within_limits(omni, {std::nan(""), 1.0, 1.0}));
}

TEST_CASE("gravity torque is the gradient of the potential energy", "[phantom][kinematics]") {
  // Weights at part of each link: V = a sin q2 - b cos q3, and the torque that holds them is its gradient.
  const Eigen::Vector2d gravity(0.07, -0.03);
  Random random(6);
  for (int i = 0; i < 100; ++i) {
    const Joints joints = random_joints(random);
    const auto potential = [&](const Joints& at) { return 0.07 * std::sin(at[1]) + 0.03 * std::cos(at[2]); };
    const Eigen::Vector3d torque = gravity_torque(gravity, joints);
    for (Eigen::Index joint = 0; joint < 3; ++joint) {
      const Joints turn = 1e-6 * Joints::Unit(joint);
      REQUIRE(torque[joint] == Approx((potential(joints + turn) - potential(joints - turn)) / 2e-6).margin(1e-9));
    }
  }
}
