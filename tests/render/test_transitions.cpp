// The third kind of instability, Wang 2006, sec. 6: pens that chatter at a border, and the force there.
#include "../catch.hpp"

#include <cmath>
#include <string>

#include "../scripted_pen.hpp"

using namespace calligraphy;
using calligraphy_test::path_of;
using calligraphy_test::placed;
using calligraphy_test::ScriptedPen;
using calligraphy_test::test_device;
using Eigen::Vector3d;

namespace {

struct Chatter {
  int changes = 0;               ///< of state
  int features = 0;              ///< passed
  int strokes = 0;               ///< started
  double max_unexplained = 0.0;  ///< step of the force, beyond what the pen's motion explains [N]
};

/// The pen oscillates by 0.1 mm about a position, every tick and then more slowly, after whatever it did before.
Chatter chatter(ScriptedPen& pen, const Vector3d& about, const Vector3d& direction) {
  Chatter result;
  bool first = true;
  InteractionState last{};
  pen.go(about - 0.0001 * direction);
  pen.max_unexplained = 0.0;
  pen.on_tick = [&](const HapticTick& tick) {
    result.changes += !first && tick.state != last;
    result.features += has_event(tick.events, TickEvent::feature_passed);
    result.strokes += has_event(tick.events, TickEvent::stroke_started);
    last = tick.state;
    first = false;
  };
  for (const int half : {1, 2, 7, 50}) {
    for (int i = 0; i < 400; ++i) pen.at(about + (i / half % 2 ? 0.0001 : -0.0001) * direction);
  }
  pen.on_tick = [](const HapticTick&) {};
  result.max_unexplained = pen.max_unexplained;
  return result;
}

using calligraphy_test::at;

}  // namespace

TEST_CASE("a pen that chatters at the paper surface changes its state once", "[render]") {
  HapticRenderer renderer({placed(U'三')}, {}, test_device());
  ScriptedPen pen(renderer);
  pen.go({0.04, 0.06, 0.005});
  const Chatter result = chatter(pen, {0.04, 0.06, 0.0}, {0, 0, -1});
  CHECK(result.changes == 1);
  CHECK(result.max_unexplained <= 1e-12);
}

namespace {

/// Lets a pen leap from height to height.
RendererOptions at_once(RendererOptions options) {
  options.limits.max_acceleration = std::numeric_limits<double>::infinity();
  return options;
}

/// A pen in the middle of the first stroke of 三.
struct InStroke {
  HapticRenderer renderer;
  ScriptedPen pen;
  Point place;
  int abandoned = 0, lifts = 0;

  explicit InStroke(const RendererOptions& options = {})
      : renderer({placed(U'三')}, {}, test_device(), at_once(options)), pen(renderer, renderer.options().servo_rate) {
    const Stroke first = strokes(renderer.page()[0].character)[0];
    const Placement& page = renderer.page()[0].placement;
    const Point start = page.to_page(first.control_points[0]);
    place = start + 0.4 * (page.to_page(first.control_points[1]) - start);
    pen.go(at(start, 0.005));
    pen.go(at(start, -0.002));
    pen.go(at(place, -0.002));
    pen.on_tick = [this](const HapticTick& tick) {
      abandoned += has_event(tick.events, TickEvent::stroke_abandoned);
      lifts += has_event(tick.events, TickEvent::lift);
    };
  }
};

}  // namespace

TEST_CASE("a pen that bounces on the paper, 1 mm high for 20 ms, keeps its stroke", "[render]") {
  InStroke test;
  for (int bounce = 0; bounce < 20; ++bounce) {
    for (int i = 0; i < 20; ++i) test.pen.at(at(test.place, 0.001));
    CHECK(test.renderer.last().state == InteractionState::writing);
    CHECK(test.renderer.last().normal == 0.0);
    for (int i = 0; i < 5; ++i) test.pen.at(at(test.place, -0.001));
  }
  CHECK(test.lifts == 0);
  CHECK(test.abandoned == 0);
  CHECK(test.renderer.last().state == InteractionState::writing);
}

TEST_CASE("a pen 5 mm above the paper is lifted at once", "[render]") {
  InStroke test;
  int too_early = 0, too_late = 0;
  test.pen.on_tick = [&](const HapticTick& tick) {
    const bool lifted = tick.state == InteractionState::separation;
    too_early += lifted && tick.device_point.z() < 0.003 - 1e-9;
    too_late += !lifted && tick.device_point.z() > 0.003 + 1e-9;
    test.abandoned += has_event(tick.events, TickEvent::stroke_abandoned);
  };
  test.pen.speed = 0.5;  // 10 ms from the paper to 5 mm above it
  test.pen.go(at(test.place, 0.005));
  for (int i = 0; i < 15; ++i) test.pen.at(at(test.place, 0.005));
  CHECK(test.renderer.last().state == InteractionState::separation);
  CHECK(too_early == 0);
  CHECK(too_late == 0);
  CHECK(test.abandoned == 1);
}

TEST_CASE("a pen that hovers 1 mm above the paper is lifted after 50 ms, at any rate", "[render]") {
  for (const double rate : {500.0, 1000.0, 4000.0}) {
    RendererOptions options;
    options.servo_rate = rate;
    options.stiffness_check = StiffnessCheck::clip;
    InStroke test(options);
    int ticks = 0;
    while (test.lifts == 0 && ticks < 10'000) {
      test.pen.at(at(test.place, 0.001));
      ++ticks;
    }
    CAPTURE(rate);
    CHECK(ticks / rate == Approx(0.05).margin(1.5 / rate));
    CHECK(test.abandoned == 1);
    // One that touches the paper again, however slightly, has not been lifted; the time begins anew.
    InStroke again(options);
    for (int bounce = 0; bounce < 5; ++bounce) {
      for (int i = 0; i < static_cast<int>(0.045 * rate); ++i) again.pen.at(at(again.place, 0.001));
      again.pen.at(at(again.place, 0.0004));  // within lift_height
    }
    CHECK(again.lifts == 0);
  }
}

TEST_CASE("as printed, a pen above the paper is lifted at once, however little", "[render]") {
  InStroke test(RendererOptions::wang2006());
  REQUIRE(test.renderer.last().state == InteractionState::writing);
  CHECK(test.pen.at(at(test.place, 1e-6)).state == InteractionState::separation);
}

TEST_CASE("a pen that chatters at the border of the box changes its state once", "[render]") {
  HapticRenderer renderer({placed(U'三')}, {}, test_device());
  const RendererOptions& options = renderer.options();
  const Eigen::AlignedBox2d box = bounding_box(renderer.page()[0]);
  const double y = box.center().y();
  for (const double border : {box.min().x() - 0.04 * options.contact.box_margin,
                              box.min().x() - 0.04 * (options.contact.box_margin + 0.05)}) {
    renderer.restart();
    ScriptedPen pen(renderer);
    pen.go({0.0, y, 0.005});
    pen.go({0.0, y, -0.002});
    CHECK(renderer.last().state == InteractionState::adjusting);
    const Chatter result = chatter(pen, {border, y, -0.002}, {1, 0, 0});
    CHECK(result.changes <= 1);
    CHECK(result.max_unexplained <= 1e-12);
  }
}

TEST_CASE("a pen that chatters at the edge of the start begins no stroke there, and one as it writes on", "[render]") {
  HapticRenderer renderer({placed(U'三')}, {}, test_device());
  ScriptedPen pen(renderer);
  const Stroke first = strokes(renderer.page()[0].character)[0];
  const Point start = renderer.page()[0].placement.to_page(first.control_points[0]);
  const Point rim = start + Point(0.0, -0.04 * renderer.options().tolerances.start_distance);
  pen.go(at(rim + Point(0.0, -0.002), 0.005));
  pen.go(at(rim + Point(0.0, -0.002), -0.001));
  CHECK(renderer.last().state == InteractionState::calibration);
  const Chatter result = chatter(pen, at(rim, -0.001), {0, -1, 0});
  CHECK(result.changes == 0);
  CHECK(result.strokes == 0);
  CHECK(result.max_unexplained <= 1e-12);
  const Point along = (renderer.page()[0].placement.to_page(first.control_points[1]) - start).normalized();
  pen.go(at(rim + Point(0.0, 0.001) + 0.002 * along, -0.001));
  CHECK(renderer.last().state == InteractionState::writing);
}

TEST_CASE("a pen that chatters at the end of the first stretch begins the stroke once", "[render]") {
  HapticRenderer renderer({placed(U'三')}, {}, test_device());
  ScriptedPen pen(renderer);
  const Stroke first = strokes(renderer.page()[0].character)[0];
  const Placement& page = renderer.page()[0].placement;
  const Point start = page.to_page(first.control_points[0]);
  const Point along = (page.to_page(first.control_points[1]) - start).normalized();
  const double stretch = page.em * renderer.options().tolerances.first_stretch;  // 1.6 mm
  pen.go(at(start, 0.005));
  pen.go(at(start, -0.001));
  const Chatter result = chatter(pen, at(start + stretch * along, -0.001), {along.x(), along.y(), 0.0});
  CHECK(result.changes == 1);
  CHECK(result.strokes == 1);
  CHECK(renderer.last().state == InteractionState::writing);
  CHECK(result.max_unexplained <= 1e-12);
}

TEST_CASE("a pen that chatters across a feature plane passes one feature point", "[render]") {
  const PlacedCharacter corner{calligraphy_test::typical_character(16), {{0.02, 0.02}, 0.04}};
  const Stroke stroke = strokes(corner.character)[0];
  const Point turn = corner.placement.to_page(stroke.control_points[1]);
  const Point along = (turn - corner.placement.to_page(stroke.control_points[0])).normalized();
  for (const double before : {0.0, 0.0015}) {  // the plane, and where it counts as crossed
    HapticRenderer renderer({corner}, {}, test_device());
    ScriptedPen pen(renderer);
    pen.go(at(corner.placement.to_page(stroke.control_points[0]), 0.005));
    pen.go(at(corner.placement.to_page(stroke.control_points[0]), -0.001));
    int features = 0;
    pen.on_tick = [&](const HapticTick& tick) { features += has_event(tick.events, TickEvent::feature_passed); };
    pen.go(at(turn - (before + 0.0002) * along, -0.001));
    const Chatter result = chatter(pen, at(turn - before * along, -0.001), {along.x(), along.y(), 0});
    CHECK(features + result.features == 1);
    CHECK(result.changes == 0);
    CHECK(result.max_unexplained <= 1e-12);
  }
}

TEST_CASE("a pen that chatters at the end of a stroke finishes it once and starts no other", "[render]") {
  HapticRenderer renderer({placed(U'三')}, {}, test_device());
  ScriptedPen pen(renderer);
  std::string events;
  const Stroke first = strokes(renderer.page()[0].character)[0];
  const Placement place = renderer.page()[0].placement;
  const Point start = place.to_page(first.control_points[0]), end = place.to_page(first.control_points[1]);
  pen.go(at(start, 0.005));
  pen.go(at(start, -0.001));
  pen.go(at(end - Point(0.0025, 0.0), -0.001));
  const Chatter result = chatter(pen, at(end - Point(0.0002, 0.0), -0.001), {1, 0, 0});
  CHECK(result.changes <= 1);
  CHECK(result.strokes == 0);
  CHECK(renderer.last().stroke == 1);
  CHECK(result.max_unexplained <= 1e-12);
}

TEST_CASE("at every transition the force changes within the rate limit and what the motion explains", "[render]") {
  // Pressed in by 5 mm and 6 mm off the stroke throughout: without the limit all steps would be near 2 to 3 N.
  HapticRenderer renderer({placed(U'永')}, {}, test_device());
  ScriptedPen pen(renderer);
  const Placement place = renderer.page()[0].placement;
  for (const Stroke& stroke : strokes(renderer.page()[0].character)) {
    std::vector<Point> path = calligraphy_test::beside(path_of(stroke, place, 1e-4), 0.006);
    pen.go(at(path.front(), 0.005));
    for (const Point& point : path) pen.go(at(point, -0.005));
    pen.go({0.0, 0.0, -0.005});  // out of the box
    pen.go(at(path.front(), -0.005));
    pen.go(at(path.back(), 0.005));
  }
  CHECK(pen.max_force > 2.0);
  CHECK(pen.max_unexplained <= 1e-12);
}
