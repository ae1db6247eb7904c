// What a pen on the paper that is not guided is told, and what it feels: Wang 2006, Fig. 4.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "../scripted_pen.hpp"

namespace hint_tests {

using namespace calligraphy;
using calligraphy_test::at;
using calligraphy_test::path_of;
using calligraphy_test::placed;
using calligraphy_test::ScriptedPen;
using calligraphy_test::test_device;

namespace {

/// A pen on 三, whose strokes run to the right, one below the other.
struct OnPage {
  HapticRenderer renderer;
  ScriptedPen pen{renderer};

  explicit OnPage(const RendererOptions& options = {}) : renderer({placed(U'三')}, {}, test_device(), options) {}

  Placement placement() const { return renderer.page()[0].placement; }
  std::vector<Point> path(int stroke) const {
    const auto all = strokes(renderer.page()[0].character);
    return path_of(all[static_cast<std::size_t>(stroke)], placement(), 1e-4);
  }
  Point start(int stroke) const { return path(stroke).front(); }
  Point end(int stroke) const { return path(stroke).back(); }
  Point along(int stroke) const { return (end(stroke) - start(stroke)).normalized(); }
  Point left(int stroke) const { return {-along(stroke).y(), along(stroke).x()}; }

  const HapticTick& down(const Point& place) {
    if (renderer.last().state != InteractionState::separation) pen.go(at(renderer.last().pen_tip.head<2>(), 0.005));
    pen.go(at(place, 0.005));
    pen.go(at(place, -0.001));
    return renderer.last();
  }
  const HapticTick& go(const Point& place) {
    pen.go(at(place, -0.001));
    return renderer.last();
  }
  const HapticTick& rest(int ticks) {
    const Eigen::Vector3d place = renderer.last().device_point;
    for (int i = 0; i < ticks; ++i) pen.at(place);
    return renderer.last();
  }
  const HapticTick& lift() {
    const Point place = renderer.last().device_point.head<2>();
    pen.go(at(place, 0.005));
    return renderer.last();
  }
};

}  // namespace

TEST_CASE("a pen in the air is told nothing, at the start to write, and nothing while it writes", "[render]") {
  OnPage page;
  page.pen.go(at(page.start(0), 0.005));
  CHECK(page.renderer.last().hint == WritingHint::none);
  CHECK(page.down(page.start(0)).hint == WritingHint::write);
  CHECK(page.rest(500).hint == WritingHint::write);
  CHECK(page.go(page.start(0) + 0.01 * page.along(0)).hint == WritingHint::none);
  CHECK(page.renderer.last().state == InteractionState::writing);
  CHECK(page.lift().hint == WritingHint::none);
}

TEST_CASE("a pen 12 mm beside the start is told that it is too far from it, and where the start is", "[render]") {
  OnPage page;
  for (const double angle : {30.0, 90.0, 135.0, 180.0, 225.0}) {  // beside the stroke, and behind it
    const double radians = angle * std::acos(-1.0) / 180.0;
    const Point place = page.start(0) + 0.012 * (std::cos(radians) * page.along(0) + std::sin(radians) * page.left(0));
    const HapticTick& tick = page.down(place);
    CAPTURE(angle);
    CHECK(tick.hint == WritingHint::too_far);
    CHECK((tick.to_start - (page.start(0) - place)).norm() < 1e-12);
    CHECK(page.rest(300).page_force.head<2>().norm() < 1e-6);
  }
  CHECK(page.down(page.start(0) + 0.007 * page.left(0)).hint == WritingHint::write);
}

TEST_CASE("a pen put down at the end or in the middle of the stroke is told so", "[render]") {
  OnPage page;
  const double length = (page.end(0) - page.start(0)).norm();
  CHECK(page.down(page.end(0)).hint == WritingHint::at_end);
  CHECK(page.down(page.end(0) - 0.1 * length * page.along(0) + 0.002 * page.left(0)).hint == WritingHint::at_end);
  CHECK(page.down(page.start(0) + 0.5 * length * page.along(0)).hint == WritingHint::in_middle);
  CHECK(page.go(page.start(0) + 0.6 * length * page.along(0)).hint == WritingHint::in_middle);
  CHECK(page.lift().hint == WritingHint::none);
  CHECK(page.renderer.last().stroke == 0);
}

TEST_CASE("a pen that sets out the other way from the start is told so until it turns", "[render]") {
  OnPage page;
  page.down(page.start(0));
  CHECK(page.go(page.start(0) - 0.003 * page.along(0)).hint == WritingHint::wrong_direction);
  CHECK(page.renderer.last().state == InteractionState::calibration);
  CHECK(page.go(page.start(0) + 0.003 * page.along(0)).state == InteractionState::writing);
  CHECK(page.renderer.last().hint == WritingHint::none);
}

TEST_CASE("a pen that writes another stroke is told so until it is lifted", "[render]") {
  OnPage page;
  page.down(page.start(2));
  double guided = 0.0;
  page.pen.on_tick = [&](const HapticTick& tick) { guided = std::max(guided, tick.attraction.norm()); };
  CHECK(page.go(page.start(2) + 0.003 * page.along(2)).hint == WritingHint::another_stroke);
  CHECK(page.go(page.end(2)).hint == WritingHint::another_stroke);
  CHECK(page.go(page.start(0)).hint == WritingHint::another_stroke);
  CHECK(page.go(page.start(0) + 0.01 * page.along(0)).hint == WritingHint::another_stroke);
  CHECK(page.renderer.last().state == InteractionState::calibration);
  CHECK(guided == 0.0);
  CHECK(page.lift().hint == WritingHint::none);
  CHECK(page.down(page.start(0)).hint == WritingHint::write);
}

TEST_CASE("a pen that slides on after a stroke is told to lift first", "[render]") {
  OnPage page;
  page.down(page.start(0));
  page.go(page.end(0));
  CHECK(page.rest(25).hint == WritingHint::lift_first);
  CHECK(page.renderer.last().stroke == 1);
  CHECK(page.go(page.start(1)).hint == WritingHint::lift_first);
  CHECK((page.renderer.last().to_start).norm() < 1e-12);  // of the stroke that is due now
  CHECK(page.go(page.start(1) + 0.01 * page.along(1)).hint == WritingHint::lift_first);
  CHECK(page.renderer.last().state == InteractionState::calibration);
  CHECK(page.lift().hint == WritingHint::none);
  CHECK(page.down(page.start(1)).hint == WritingHint::write);
}

TEST_CASE("a pen that left the stroke it writes is told that it is too far away until it is back", "[render]") {
  OnPage page;
  page.down(page.start(0));
  const Point place = page.start(0) + 0.01 * page.along(0);
  page.go(place);
  page.go(place - 0.0065 * page.left(0));  // beyond 0.12 em
  CHECK(page.rest(2).hint == WritingHint::off_stroke);
  CHECK(page.renderer.last().state == InteractionState::writing);
  page.go(place - 0.003 * page.left(0));
  CHECK(page.rest(2).hint == WritingHint::off_stroke);
  page.go(place - 0.002 * page.left(0));  // within the corridor
  CHECK(page.rest(2).hint == WritingHint::none);
}

TEST_CASE("a finished page has nothing to tell", "[render]") {
  OnPage page;
  page.pen.write(page.renderer.page()[0]);
  CHECK(page.renderer.last().character == 1);
  CHECK(page.down(page.start(0)).hint == WritingHint::none);
}

TEST_CASE("each hint has a name of its own", "[render]") {
  const std::vector<std::string> names = {
      "none",       "write",      "too_far", "at_end", "in_middle", "wrong_direction", "another_stroke",
      "off_stroke", "lift_first", "warm_motors", "lifted_early"};
  for (std::size_t i = 0; i < names.size(); ++i) CHECK(to_string(static_cast<WritingHint>(i)) == names[i]);
}

TEST_CASE("a pen put down at the end or in the middle meets resistance backwards and none forwards, Fig. 4",
          "[render]") {
  for (const double share : {0.5, 1.0}) {
    OnPage page;
    CAPTURE(share);
    const Point along = page.along(0);
    const Point place = page.start(0) + share * (page.end(0) - page.start(0));
    page.pen.speed = 0.02;
    page.down(place);
    CHECK(page.rest(200).wrong_way == Point(0, 0));
    CHECK(page.go(place - 0.0019 * along).wrong_way == Point(0, 0));  // within the dead band of 0.05 em
    CHECK(page.go(place - 0.004 * along).wrong_way.isApprox(200.0 * 0.002 * along, 1e-6));
    // It is felt, with what the dampers do to a pen that rests.
    CHECK((page.rest(300).page_force.head<2>() - 200.0 * 0.002 * along).norm() < 1e-3);
    CHECK(page.go(place - 0.009 * along).wrong_way.isApprox(1.0 * along, 1e-6));  // wrong_way_limit
    CHECK(page.go(place).wrong_way.norm() < 1e-9);
    double forwards = 0.0;
    page.pen.on_tick = [&](const HapticTick& tick) { forwards = std::max(forwards, tick.wrong_way.norm()); };
    page.down(place);
    page.go(place + 0.008 * along);
    CHECK(forwards == 0.0);
    CHECK(page.renderer.last().stroke == 0);  // nothing was written
    CHECK(page.renderer.last().state == InteractionState::calibration);
  }
}

TEST_CASE("before a stroke is begun guidance acts across its first stretch only", "[render]") {
  OnPage page;
  const Point left = page.left(0);
  page.down(page.start(0) - 0.002 * page.along(0) + 0.003 * left);
  CHECK(page.renderer.last().page_force.head<2>().norm() < 0.1);  // it fades in
  CHECK((page.rest(300).attraction + 600.0 * 0.003 * left).norm() < 1e-9);
  CHECK((page.renderer.last().page_force.head<2>() + 600.0 * 0.003 * left).norm() < 1e-6);
  CHECK(page.renderer.last().state == InteractionState::calibration);
}

TEST_CASE("guidance that lets go of a pen is withdrawn within guidance_fade_out, on the paper and in the air",
          "[render]") {
  for (const bool lifts : {false, true}) {
    OnPage page;
    CAPTURE(lifts);
    page.down(page.start(0));
    page.go(page.start(0) + 0.01 * page.along(0));
    const double aside = lifts ? 0.004 : 0.0045;
    page.go(page.start(0) + 0.01 * page.along(0) - aside * page.left(0));
    page.rest(300);
    const double before = page.renderer.last().page_force.head<2>().norm();
    CHECK(before > 1.0);
    page.pen.speed = 0.25;
    if (lifts) {
      page.lift();
    } else {
      page.go(page.start(0) + 0.01 * page.along(0) - 0.0085 * page.left(0));  // away from the stroke
    }
    double last = page.renderer.last().page_force.head<2>().norm();
    CHECK(last > 0.8 * before);
    bool falls = true;
    for (int tick = 0; tick < 300; ++tick) {
      const double now = page.rest(1).page_force.head<2>().norm();
      falls = falls && now <= last + 1e-9;
      if (tick == 50) CHECK(now > 0.7 * before);
      if (tick == 140) CHECK(now > 0.4 * before);  // half of it at half of the time
      last = now;
    }
    CHECK(falls);
    CHECK(last < 1e-6);
  }
}

}  // namespace hint_tests
