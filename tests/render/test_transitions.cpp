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
  int changes = 0;   ///< of state
  int features = 0;  ///< passed
  int strokes = 0;   ///< started
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

TEST_CASE("a pen that chatters at the border of the box changes its state once", "[render]") {
  HapticRenderer renderer({placed(U'三')}, {}, test_device());
  const RendererOptions& options = renderer.options();
  const Eigen::AlignedBox2d box = bounding_box(renderer.page()[0]);
  const double y = box.center().y();
  for (const double border :
       {box.min().x() - options.box_margin, box.min().x() - options.box_margin - options.box_hysteresis}) {
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

TEST_CASE("a pen that chatters at the start circle begins the stroke once", "[render]") {
  HapticRenderer renderer({placed(U'三')}, {}, test_device());
  ScriptedPen pen(renderer);
  const Stroke first = strokes(renderer.page()[0].character)[0];
  const Point start = renderer.page()[0].placement.to_page(first.control_points[0]);
  const Point rim = start + Point(0.0, -renderer.options().start_radius);
  pen.go(at(rim + Point(0.0, -0.002), 0.005));
  pen.go(at(rim + Point(0.0, -0.002), -0.001));
  CHECK(renderer.last().state == InteractionState::calibration);
  const Chatter result = chatter(pen, at(rim, -0.001), {0, -1, 0});
  CHECK(result.changes <= 1);
  CHECK(result.strokes <= 1);
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
  const Chatter result = chatter(pen, at(end - Point(0.0015, 0.0), -0.001), {1, 0, 0});
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
