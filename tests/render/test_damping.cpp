// The dampers beside the springs: of the paper, of guidance and of friction, and what a tick reports of them.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>

#include "../scripted_pen.hpp"

using namespace calligraphy;
using calligraphy_test::at;
using calligraphy_test::placed;
using calligraphy_test::ScriptedPen;
using calligraphy_test::test_device;
using Eigen::Vector3d;

namespace {

constexpr double damping = 4.0;      // of guidance and of the paper, by default [N s/m]
constexpr double free_share = 0.15;  // of it, where the pen is free to move

/// Eq. (9) with the stiffness setting in over the first `onset`: the integral of K min(1, depth / onset).
double paper_spring(double depth, double onset = 0.0005) {
  return 600.0 * (depth < onset ? depth * depth / (2.0 * onset) : depth - 0.5 * onset);
}

/// A pen on the first, straight stroke of 三, 10 mm from its start and pressed in by 2 mm.
struct OnStroke {
  HapticRenderer renderer;
  ScriptedPen pen{renderer};
  Point start, along, left;
  Vector3d place = {0, 0, 0}, place_before = {0, 0, 0};

  explicit OnStroke(const RendererOptions& options = {}, const PlacedCharacter& character = placed(U'三'))
      : renderer({character}, {}, test_device(), options) {
    const Stroke stroke = strokes(renderer.page()[0].character)[0];
    const Placement& place = renderer.page()[0].placement;
    start = place.to_page(stroke.control_points[0]);
    along = (place.to_page(stroke.control_points[1]) - start).normalized();
    left = {-along.y(), along.x()};
    pen.on_tick = [this](const HapticTick& tick) { note(tick); };
    pen.go(at(start, 0.005));
    pen.go(at(start, -0.002));
    go(0.010, 0.0);
  }
  void note(const HapticTick& tick) {
    place_before = place;
    place = tick.device_point;
  }
  void go(double forwards, double sideways, double z = -0.002) {
    pen.go(at(start + forwards * along + sideways * left, z));
  }
  Point viscous() const { return renderer.last().viscous.head<2>(); }
  /// Of the last tick [m/s].
  double speed() const { return 1000.0 * (place - place_before).norm(); }
  double against(const Point& direction) const { return -viscous().dot(direction); }
};

}  // namespace

TEST_CASE("guidance damps motion across the stroke fully and along it by 15 %", "[render]") {
  OnStroke test;
  test.go(0.015, 0.0);  // at 0.1 m/s for long enough, compared with the filter of the velocity
  CHECK(test.speed() == Approx(0.1).epsilon(0.05));
  CHECK(test.against(test.along) == Approx(free_share * damping * test.speed()).epsilon(1e-3));
  CHECK(std::abs(test.against(test.left)) < 1e-9);
  test.go(0.015, 0.004);
  CHECK(test.against(test.left) == Approx(damping * test.speed()).epsilon(1e-3));
  test.go(0.015, 0.0);
  CHECK(test.against(test.left) == Approx(-damping * test.speed()).epsilon(1e-3));
  test.pen.speed = 0.05;
  test.go(0.018, 0.003);
  const Point expected = test.speed() / std::sqrt(2.0) * damping * Point(free_share * test.along + test.left);
  CHECK((test.viscous() + expected).norm() < 1e-3 * expected.norm());
}

TEST_CASE("on the way back guidance damps along the stroke fully, beyond the dead band", "[render]") {
  OnStroke test;
  test.go(0.020, 0.0);
  test.pen.speed = 0.02;
  test.go(0.0185, 0.0);
  CHECK(test.against(test.along) == Approx(-free_share * damping * test.speed()).epsilon(1e-3));
  test.go(0.012, 0.0);
  CHECK(test.against(test.along) == Approx(-damping * test.speed()).epsilon(1e-3));
}

TEST_CASE("before its start guidance damps along the stroke fully, where the spring pulls along it too", "[render]") {
  OnStroke test;
  test.go(0.010, 0.0, 0.005);
  test.go(-0.006, 0.0, 0.005);
  test.go(-0.006, 0.0, -0.002);
  test.pen.speed = 0.02;
  test.go(-0.005, 0.0);
  REQUIRE(test.renderer.last().state == InteractionState::calibration);  // guided across the stroke only
  CHECK(test.against(test.along) == Approx(free_share * damping * test.speed()).epsilon(1e-3));
  test.go(-0.001, 0.0);
  REQUIRE(test.renderer.last().state == InteractionState::writing);
  CHECK(test.against(test.along) == Approx(damping * test.speed()).epsilon(1e-3));
  // And a pen astray that is led to the start.
  RendererOptions options;
  options.guidance.to_start = true;
  options.contact.box_margin = 0.75;
  OnStroke led(options);
  led.go(0.016, 0.0, 0.005);
  led.go(0.016, 0.015, 0.005);
  led.go(0.016, 0.015, -0.002);
  REQUIRE(led.renderer.last().state == InteractionState::calibration);
  led.go(0.011, 0.015);
  CHECK(led.against(led.along) == Approx(-damping * led.speed()).epsilon(1e-3));
}

TEST_CASE("where no spring guides, 15 % of the damping is left on the paper, and none in the air", "[render]") {
  OnStroke test;
  test.go(0.010, -0.018);
  REQUIRE(test.renderer.last().attraction == Point(0, 0));
  for (const Point& direction : {test.along, test.left}) {
    const Point before = test.renderer.last().pen_tip.head<2>();
    test.pen.go(at(before + 0.004 * direction, -0.002));
    CHECK(test.against(direction) == Approx(free_share * damping * test.speed()).epsilon(1e-3));
    test.pen.go(at(before, -0.002));
  }
  test.go(0.010, -0.018, 0.004);
  test.go(0.015, -0.018, 0.004);
  REQUIRE(test.renderer.last().state == InteractionState::separation);
  CHECK(test.renderer.last().viscous == Vector3d(0, 0, 0));
}

TEST_CASE("the damping of guidance fades with assistance as its spring does", "[render]") {
  RendererOptions options;
  options.guidance.assist.enabled = true;
  OnStroke test(options);
  test.go(0.035, 0.0);
  test.go(0.035, 0.0, 0.005);
  const double assistance = test.renderer.last().assistance;
  REQUIRE(test.renderer.last().stroke == 1);
  REQUIRE(assistance < 0.9);
  const Stroke second = strokes(test.renderer.page()[0].character)[1];
  const Placement& place = test.renderer.page()[0].placement;
  const Point start = place.to_page(second.control_points[0]);
  const Point along = (place.to_page(second.control_points[1]) - start).normalized(), left(-along.y(), along.x());
  test.pen.go(at(start, 0.005));
  test.pen.go(at(start, -0.002));
  test.pen.go(at(start + 0.008 * along, -0.002));
  test.pen.go(at(start + 0.008 * along + 0.004 * left, -0.002));
  CHECK(test.against(left) ==
        Approx((assistance + free_share * (1.0 - assistance)) * damping * test.speed()).epsilon(1e-3));
}

TEST_CASE("a stroke that attracts less damps less, and one that attracts more damps no more", "[render]") {
  RendererOptions options;
  options.stiffness_check = StiffnessCheck::clip;
  for (const double factor : {0.4, 1.5}) {
    OnStroke test(options, {calligraphy_test::typical_character(1, {factor, factor}), {{0.02, 0.02}, 0.04}});
    test.go(0.010, 0.004);
    const double share = std::min(1.0, factor);
    CHECK(test.against(test.left) ==
          Approx((share + free_share * (1.0 - share)) * damping * test.speed()).epsilon(1e-3));
  }
}

TEST_CASE("the damper of the paper acts along its normal, within the normal force of the tick", "[render]") {
  OnStroke test;
  test.pen.speed = 0.02;
  test.go(0.010, 0.0, -0.004);
  CHECK(test.renderer.last().viscous.z() == Approx(damping * test.speed()).epsilon(1e-3));
  CHECK(test.renderer.last().normal == Approx(paper_spring(0.004) + damping * test.speed()).epsilon(1e-4));
  test.go(0.010, 0.0, -0.001);
  CHECK(test.renderer.last().viscous.z() == Approx(-damping * test.speed()).epsilon(1e-3));
  CHECK(test.renderer.last().normal == Approx(paper_spring(0.001) - damping * test.speed()).epsilon(1e-3));
}

TEST_CASE("spring and damper of the paper set in over paper_onset, so that a touch is no step", "[render]") {
  for (const double onset : {RendererOptions{}.paper.onset, 0.002, 0.0}) {
    RendererOptions options;
    options.paper.onset = onset;
    OnStroke test(options);
    test.go(0.010, 0.0, 0.0002);
    test.pen.speed = 0.002;  // 2 um per tick
    double off = 0.0, spring_off = 0.0, stiffest = 0.0, before = 0.0;
    int seen = 0;
    test.pen.on_tick = [&](const HapticTick& tick) {
      test.note(tick);
      if (tick.device_point.z() > 0.0) return;
      const double share = tick.penetration < onset ? tick.penetration / onset : 1.0;
      const double spring = tick.normal - tick.viscous.z(), way = test.place_before.z() - test.place.z();
      off = std::max(off, std::abs(tick.viscous.z() - share * damping * test.speed()));
      spring_off = std::max(spring_off, std::abs(spring - paper_spring(tick.penetration, onset)));
      // Relative to the damper, the spring is at no depth stiffer than both are in full.
      if (seen > 0) stiffest = std::max(stiffest, (spring - before) / way / (tick.viscous.z() / test.speed()));
      before = spring;
      ++seen;
    };
    test.go(0.010, 0.0, -1.5 * onset - 0.0004);
    CAPTURE(onset);
    CHECK(seen > 150);
    CHECK(off < 1e-4 * damping * 0.002);
    CHECK(spring_off < 1e-12);
    CHECK(stiffest == Approx(600.0 / damping).epsilon(1e-3));
  }
  CHECK(RendererOptions{}.paper.onset == 0.0005);
}

TEST_CASE("a pen at rest in the paper feels K d^2 / (2 onset) up to the onset and K (d - onset / 2) beyond",
          "[render]") {
  OnStroke test;
  for (const auto& [depth, force] :
       {std::pair{0.0001, 0.006}, {0.00025, 0.0375}, {0.0005, 0.15}, {0.001, 0.45}, {0.002, 1.05}}) {
    test.go(0.010, 0.0, -depth);
    for (int i = 0; i < 100; ++i) test.go(0.010, 0.0, -depth);
    CAPTURE(depth);
    CHECK(test.renderer.last().page_force.z() == Approx(force));
  }
}

TEST_CASE("where the saturating law is softer, its damping falls by the square root of that", "[render]") {
  RendererOptions options;
  options.guidance.force = saturating_guidance;
  options.guidance.limit = 1.2;
  options.contact.box_margin = 1.5;
  for (const double distance : {0.015, 0.03}) {
    OnStroke test(options);
    test.go(0.010, distance);
    REQUIRE(test.renderer.last().state == InteractionState::writing);
    // The force is K d / sqrt(1 + (K d / limit)^2).
    const double share = std::pow(1.0 + std::pow(600.0 * distance / 1.2, 2.0), -0.25);
    CHECK(share < 0.4);
    CAPTURE(distance, share);
    CHECK(test.against(test.left) ==
          Approx((share + free_share * (1.0 - share)) * damping * test.speed()).epsilon(1e-3));
  }
  // Near the stroke it is as stiff as the linear one.
  OnStroke near(options);
  near.pen.speed = 0.01;
  near.go(0.010, -0.0005);
  near.go(0.010, 0.0001);
  CHECK(near.against(near.left) == Approx(damping * near.speed()).epsilon(2e-3));
}

TEST_CASE("paper never pulls, however fast the pen is lifted", "[render]") {
  OnStroke test;
  double least = 1.0, braked = 0.0;
  test.pen.on_tick = [&](const HapticTick& tick) {
    least = std::min({least, tick.normal, tick.page_force.z()});
    braked = std::min(braked, tick.viscous.z() + paper_spring(tick.penetration));
  };
  for (const double speed : {0.2, 1.0, 3.0}) {
    test.pen.speed = speed;
    test.go(0.010, 0.0, 0.004);
    test.pen.speed = 0.1;
    test.go(0.010, 0.0, -0.006);
  }
  CHECK(least == 0.0);
  CHECK(braked > -1e-12);  // what is reported as viscous is what the tick renders
}

TEST_CASE("friction is damped where its spring changes, and not where the anchor slides along", "[render]") {
  RendererOptions options;
  options.paper.friction.coefficient = 0.2;
  OnStroke test(options);
  test.pen.speed = 0.01;
  test.go(0.016, 0.0);  // N = 1.05 N, mu N / k = 0.42 mm: it slides
  CHECK(test.against(test.along) == Approx(free_share * damping * test.speed()).epsilon(1e-3));
  CHECK(test.renderer.last().friction.dot(test.along) == Approx(-0.2 * 1.05).epsilon(1e-3));
  test.go(0.0154, 0.0);  // back by less than twice that: it sticks
  CHECK(test.against(test.along) == Approx(-(free_share * damping + 2.5) * test.speed()).epsilon(1e-3));
  CHECK(test.renderer.last().friction.dot(test.along) ==
        Approx(-0.2 * 1.05 + 500.0 * 0.0006 + 2.5 * test.speed()).epsilon(1e-3));
}

TEST_CASE("the damping of friction is filtered as that of guidance is", "[render]") {
  RendererOptions options;
  options.paper.friction.coefficient = 0.2;
  OnStroke test(options);
  test.pen.speed = 0.01;
  test.go(0.016, 0.0);
  // A reversal: in its first tick a low-pass at 50 Hz passes 1 - exp(-2 pi 50 Hz 1 ms) of the change.
  const double speed = test.speed(), passed = 1.0 - std::exp(-0.1 * 3.14159265);
  test.pen.at(at(test.start + (0.016 - 0.001 * speed) * test.along, -0.002));
  const double guidance = free_share * damping * (1.0 - 2.0 * passed) * speed;
  CHECK(test.against(test.along) == Approx(guidance - 2.5 * passed * speed).epsilon(1e-3));
}
