// Motion mapping, Wang 2006, sec. 4.2, eq. (2)-(5): affine, and the drift of the integral as printed.
#include "../catch.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include <calligraphy/model/character_list.hpp>
#include <calligraphy/render/haptic_renderer.hpp>
#include <calligraphy/render/motion_mapping.hpp>

#include "../hard_cases.hpp"

using namespace calligraphy;
using calligraphy_test::Sequence;
using Eigen::Vector3d;

namespace {

Vector3d random_vector(Sequence& random) {
  const double x = random.between(-0.2, 0.2), y = random.between(-0.2, 0.2);
  return {x, y, random.between(-0.2, 0.2)};
}

MotionMapping random_mapping(Sequence& random) {
  MotionMapping mapping;
  mapping.rotation = Eigen::AngleAxisd(random.between(0.0, 3.0), random_vector(random).normalized()).toRotationMatrix();
  mapping.offset = random_vector(random);
  mapping.scale = random.between(0.2, 5.0);
  return mapping;
}

/// Maximum position error of a circle of 20 mm at 1 Hz after a quarter, half, three quarters and a whole turn [m].
double error_on_a_circle(Rules rules, double rate) {
  Capabilities device;
  device.peak_force = 3.3;
  RendererOptions options;
  options.servo_rate = rate;
  options.rules = rules;
  options.stiffness_check = StiffnessCheck::clip;  // nothing is touched here
  HapticRenderer renderer({{paper_example(), {}}}, MotionMapping{}, device, options);
  constexpr double radius = 0.02, turn = 2.0 * std::numbers::pi;
  double worst = 0.0;
  for (int i = 0; i <= static_cast<int>(rate); ++i) {
    const double time = i / rate;
    DeviceState state;
    state.time = time;
    state.position = radius * Vector3d(std::cos(turn * time), std::sin(turn * time), 1.0);
    state.velocity = radius * turn * Vector3d(-std::sin(turn * time), std::cos(turn * time), 0.0);
    worst = std::max(worst, (renderer.update(state).device_point - state.position).norm());
  }
  return worst;
}

}  // namespace

TEST_CASE("to_device inverts to_page", "[render]") {
  Sequence random(1);
  for (int i = 0; i < 200; ++i) {
    const MotionMapping mapping = random_mapping(random);
    const Vector3d device = random_vector(random);
    CHECK((mapping.to_device(mapping.to_page(device)) - device).norm() < 1e-14);
  }
}

TEST_CASE("the mapping preserves power: force times velocity is the same on both sides", "[render]") {
  Sequence random(2);
  for (int i = 0; i < 200; ++i) {
    const MotionMapping mapping = random_mapping(random);
    const Vector3d velocity = random_vector(random), force = random_vector(random);
    CHECK(mapping.force_to_device(force).dot(velocity) ==
          Approx(force.dot(mapping.velocity_to_page(velocity))).margin(1e-15));
  }
}

TEST_CASE("velocities map like differences of positions, eq. (2)", "[render]") {
  Sequence random(3);
  const MotionMapping mapping = random_mapping(random);
  const Vector3d from = random_vector(random), way = random_vector(random);
  CHECK((mapping.to_page(from + way) - mapping.to_page(from) - mapping.velocity_to_page(way)).norm() < 1e-14);
  CHECK(mapping.velocity_to_page(way).norm() == Approx(mapping.scale * way.norm()));
}

TEST_CASE("an upright page lies in the x-y plane of the device, a desk page flat on the desk", "[render]") {
  const MotionMapping upright = upright_page(0.16, 0.12);
  CHECK(upright.to_page({0, 0, 0}).isApprox(Vector3d(0.08, 0.06, 0.0)));
  CHECK(upright.to_page({0.01, 0.02, 0.03}).isApprox(Vector3d(0.09, 0.08, 0.03)));
  const MotionMapping flat = desk_page(0.16, 0.12);
  CHECK(flat.to_page({0, 0, 0}).isApprox(Vector3d(0.08, 0.06, 0.0)));
  CHECK(flat.to_page({0.01, 0, 0}).isApprox(Vector3d(0.09, 0.06, 0.0)));
  CHECK(flat.to_page({0, 0, -0.01}).isApprox(Vector3d(0.08, 0.07, 0.0)));  // away from the user
  CHECK(flat.to_page({0, 0.01, 0}).isApprox(Vector3d(0.08, 0.06, 0.01)));  // up is out of the paper
  for (const MotionMapping& mapping : {upright, flat}) CHECK(mapping.rotation.determinant() == Approx(1.0));
}

TEST_CASE("the centre of a page lies at the device origin for every motion scale", "[render]") {
  for (const double scale : {0.25, 1.0, 2.0}) {
    for (const MotionMapping& mapping : {upright_page(0.16, 0.12, scale), desk_page(0.16, 0.12, scale)}) {
      CHECK(mapping.to_page(Eigen::Vector3d::Zero()).isApprox(Eigen::Vector3d(0.08, 0.06, 0.0)));
      CHECK(mapping.scale == scale);
    }
    CHECK(upright_page(0.16, 0.12, scale).to_page({0.01, 0.0, 0.0}).x() == Approx(0.08 + 0.01 * scale));
    CHECK(desk_page(0.16, 0.12, scale).to_page({0.0, 0.0, -0.01}).y() == Approx(0.06 + 0.01 * scale));
    CHECK(desk_page(0.16, 0.12, scale).to_page({0.0, 0.01, 0.0}).z() == Approx(0.01 * scale));
  }
}

TEST_CASE("eq. (3) as printed depends on the rate and misses the position, the affine map does not", "[render]") {
  // Rectangle rule for the velocity on a circle: after half a turn the error is |v| dt = 2 pi r / rate, to first order.
  const double at_100 = error_on_a_circle(Rules::wang2006, 100.0);
  const double at_1000 = error_on_a_circle(Rules::wang2006, 1000.0);
  constexpr double speed = 2.0 * std::numbers::pi * 0.02;
  CHECK(at_100 == Approx(speed / 100.0).epsilon(0.05));    // 1.26 mm
  CHECK(at_1000 == Approx(speed / 1000.0).epsilon(0.05));  // 0.126 mm
  CHECK(error_on_a_circle(Rules::revised, 100.0) < 1e-15);
  CHECK(error_on_a_circle(Rules::revised, 1000.0) < 1e-15);
}

TEST_CASE("eq. (3) as printed never recovers from a small constant error of the velocity", "[render]") {
  Capabilities device;
  device.peak_force = 3.3;
  RendererOptions options;
  options.rules = Rules::wang2006;
  HapticRenderer renderer({{paper_example(), {}}}, MotionMapping{}, device, options);
  DeviceState state;
  state.position = {0.0, 0.0, 0.01};
  state.velocity = {0.001, 0.0, 0.0};  // an error of 1 mm/s for a pen at rest
  for (int i = 0; i <= 10'000; ++i) {
    state.time = i / 1000.0;
    renderer.update(state);
  }
  CHECK(renderer.last().device_point.x() == Approx(0.01).epsilon(1e-6));  // 10 mm in 10 s
}
