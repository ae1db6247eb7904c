// Writing with a scripted pen: Wang 2006, sec. 2.2 steps 1-4, sec. 2.3, sec. 4.3.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <calligraphy/base/error.hpp>

#include "../allocation_counter.hpp"
#include "../sanitized.hpp"
#include "../scripted_pen.hpp"

using namespace calligraphy;
using calligraphy_test::path_of;
using calligraphy_test::placed;
using calligraphy_test::ScriptedPen;
using calligraphy_test::test_device;
using Eigen::Vector3d;

namespace {

HapticRenderer renderer_of(std::u32string_view text, const RendererOptions& options = {},
                           const MotionMapping& mapping = {}) {
  std::vector<PlacedCharacter> page;
  for (const char32_t code : text) page.push_back(placed(code, {0.02 + 0.05 * static_cast<double>(page.size()), 0.02}));
  return {page, mapping, test_device(), options};
}

/// Events in order of occurrence, one letter each.
struct Log {
  std::string letters;
  int features = 0;

  void operator()(const HapticTick& tick) {
    const std::pair<TickEvent, char> names[] = {{TickEvent::stroke_started, 's'},
                                                {TickEvent::stroke_finished, 'f'},
                                                {TickEvent::stroke_abandoned, 'a'},
                                                {TickEvent::character_finished, 'C'},
                                                {TickEvent::page_finished, 'P'}};
    for (const auto& [event, letter] : names) {
      if (has_event(tick.events, event)) letters += letter;
    }
    features += has_event(tick.events, TickEvent::feature_passed);
  }
};

using calligraphy_test::at;

}  // namespace

TEST_CASE("a pen that writes 永 accurately finishes each of its strokes in order", "[render]") {
  HapticRenderer renderer = renderer_of(U"永");
  ScriptedPen pen(renderer);
  Log log;
  int last_stroke = 0, falls = 0;
  double max_attraction = 0.0;
  pen.on_tick = [&](const HapticTick& tick) {
    log(tick);
    falls += tick.stroke < last_stroke && tick.character == 0;
    last_stroke = tick.stroke;
    if (!has_event(tick.events, TickEvent::feature_passed)) {
      max_attraction = std::max(max_attraction, tick.attraction.norm());
    }
  };
  pen.write(renderer.page()[0]);
  CHECK(log.letters == "sfsfsfsfsfCP");
  CHECK(log.features == 1 + 3 + 2 + 1 + 1);
  CHECK(falls == 0);
  CHECK(renderer.last().character == 1);
  // On the path there is no guidance force except in the last 1.5 mm before a corner, where the next element already
  // attracts.
  CHECK(max_attraction <= renderer.options().guidance.stiffness * 0.0016);
}

TEST_CASE("characters are written one after another, and writing after the last changes nothing", "[render]") {
  HapticRenderer renderer = renderer_of(U"北京一");
  ScriptedPen pen(renderer);
  Log log;
  pen.on_tick = [&](const HapticTick& tick) { log(tick); };
  for (const PlacedCharacter& character : renderer.page()) pen.write(character);
  CHECK(log.letters == "sfsfsfsfsfCsfsfsfsfsfsfsfsfCsfCP");
  pen.write(renderer.page()[0]);
  CHECK(log.letters == "sfsfsfsfsfCsfsfsfsfsfsfsfsfCsfCP");
  CHECK(renderer.last().character == 3);
  CHECK(renderer.last().force == Vector3d(0, 0, 0));
}

TEST_CASE("each built-in character can be written, exactly and with an offset of 1 mm", "[render]") {
  for (const Character& character : built_in_characters().characters) {
    for (const double offset : {0.0, 0.001}) {
      HapticRenderer renderer({{character, {{0.02, 0.02}, 0.04}}}, {}, test_device());
      ScriptedPen pen(renderer);
      Log log;
      pen.on_tick = [&](const HapticTick& tick) { log(tick); };
      pen.write(renderer.page()[0], offset);
      INFO("U+" << std::hex << static_cast<unsigned>(character.code) << ", " << offset << " m: " << log.letters);
      CHECK(renderer.last().character == 1);
      CHECK(pen.max_unexplained <= 1e-12);
    }
  }
}

TEST_CASE("finished strokes are closed: writing one again makes no progress", "[render]") {
  HapticRenderer renderer = renderer_of(U"三");
  ScriptedPen pen(renderer);
  const auto first = path_of(strokes(renderer.page()[0].character)[0], renderer.page()[0].placement, 1e-4);
  pen.write(first);
  CHECK(renderer.last().stroke == 1);
  Log log;
  double in_plane = 0.0;
  pen.on_tick = [&](const HapticTick& tick) { log(tick), in_plane = std::max(in_plane, tick.attraction.norm()); };
  pen.write(first);
  CHECK(renderer.last().stroke == 1);
  CHECK(log.letters.empty());
  CHECK(in_plane == 0.0);
}

TEST_CASE("strokes out of order and backwards are not accepted", "[render]") {
  HapticRenderer renderer = renderer_of(U"三");
  ScriptedPen pen(renderer);
  const auto all = strokes(renderer.page()[0].character);
  pen.write(path_of(all[2], renderer.page()[0].placement, 1e-4));
  pen.write(path_of(all[1], renderer.page()[0].placement, 1e-4));
  CHECK(renderer.last().stroke == 0);
  std::vector<Point> path = path_of(all[0], renderer.page()[0].placement, 1e-4);
  std::reverse(path.begin(), path.end());
  pen.write(path);
  CHECK(renderer.last().stroke == 0);
}

TEST_CASE("before a stroke only a pen that is nearer to its start than to any to come is guided to it", "[render]") {
  // Two lines to the right, 0.12 em apart: both starts are within start_distance.
  const std::vector<StrokeInput> lines = {{1, {{0.2, 0.5}, {0.8, 0.5}}, {}}, {1, {{0.2, 0.38}, {0.8, 0.38}}, {}}};
  const PlacedCharacter two{make_character(U'\u4E8C', lines), {{0.02, 0.02}, 0.04}};
  for (const bool guide_to_start : {false, true}) {
    RendererOptions options;
    options.guidance.to_start = guide_to_start;
    for (const bool nearer : {true, false}) {
      HapticRenderer renderer({two}, {}, test_device(), options);
      ScriptedPen pen(renderer);
      const Point tip = two.placement.to_page({0.2, nearer ? 0.53 : 0.36});
      pen.go(calligraphy_test::at(tip, 0.005));
      for (int tick = 0; tick < 300; ++tick) pen.at(calligraphy_test::at(tip, -0.001));
      CAPTURE(guide_to_start, nearer);
      CHECK(renderer.last().state == InteractionState::calibration);
      CHECK(renderer.last().hint == WritingHint::write);
      CHECK((renderer.last().attraction.norm() > 0.0) == nearer);
    }
  }
}

TEST_CASE("lifting the pen in mid-stroke abandons the stroke, which begins again at its start", "[render]") {
  HapticRenderer renderer = renderer_of(U"永");
  ScriptedPen pen(renderer);
  const auto all = strokes(renderer.page()[0].character);
  pen.write(path_of(all[0], renderer.page()[0].placement, 1e-4));
  std::vector<Point> second = path_of(all[1], renderer.page()[0].placement, 1e-4);
  Log log;
  double written = 0.0;
  pen.on_tick = [&](const HapticTick& tick) {
    log(tick);
    if (has_event(tick.events, TickEvent::stroke_abandoned)) written = tick.covered;
  };
  pen.write({second.begin(), second.begin() + static_cast<std::ptrdiff_t>(second.size() / 2)});
  CHECK(written == Approx(0.5).margin(0.1));  // what a display may still tell
  CHECK(log.letters == "sa");
  CHECK(renderer.last().stroke == 1);
  pen.write(
      {second.begin() + static_cast<std::ptrdiff_t>(second.size() / 2), second.end()});  // the rest alone is no stroke
  CHECK(log.letters == "sa");
  log.features = 0;
  pen.write(second);
  CHECK(log.letters == "sasf");
  CHECK(log.features == 3);  // all of them again: the stack was refilled
  CHECK(renderer.last().stroke == 2);
}

TEST_CASE("the next stroke begins with a new contact, or by sliding where that is selected", "[render]") {
  RendererOptions sliding;
  sliding.contact.lift_between_strokes = false;
  for (const bool slides : {false, true}) {
    HapticRenderer renderer = renderer_of(U"三", slides ? sliding : RendererOptions{});
    ScriptedPen pen(renderer);
    const Placement place = renderer.page()[0].placement;
    std::vector<Point> path = path_of(strokes(renderer.page()[0].character)[0], place, 1e-4);
    for (const Point& point : path_of(strokes(renderer.page()[0].character)[1], place, 1e-4)) path.push_back(point);
    pen.write(path);
    CHECK(renderer.last().stroke == (slides ? 2 : 1));
  }
}

TEST_CASE("Table 2: the force of each state and where it keeps the pen tip", "[render]") {
  RendererOptions options;
  options.paper.onset = 0.0;  // eq. (9) as it is
  HapticRenderer renderer = renderer_of(U"三", options);
  ScriptedPen pen(renderer);
  const Placement place = renderer.page()[0].placement;
  const Stroke first = strokes(renderer.page()[0].character)[0];
  const Point start = place.to_page(first.control_points[0]), end = place.to_page(first.control_points[1]);
  const Point middle = 0.5 * (start + end);
  const auto settle = [&](const Point& point, double z) -> const HapticTick& {
    pen.go(at(point, z));
    for (int i = 0; i < 100; ++i) pen.at(at(point, z));
    return renderer.last();
  };
  CHECK(settle(middle, 0.01).state == InteractionState::separation);
  CHECK(renderer.last().force == Vector3d(0, 0, 0));
  CHECK(renderer.last().pen_tip == renderer.last().device_point);

  CHECK(settle(middle, -0.002).state == InteractionState::calibration);
  CHECK(renderer.last().force.isApprox(Vector3d(0, 0, 0.002 * renderer.options().paper.stiffness)));
  CHECK(renderer.last().pen_tip.isApprox(at(middle, 0.0)));

  settle(middle, 0.01);
  CHECK(settle({0.15, 0.15}, -0.002).state == InteractionState::adjusting);
  CHECK(renderer.last().force.norm() < 1e-9);

  settle({0.15, 0.15}, 0.01);
  settle(start, 0.01);
  CHECK(settle(start, -0.002).state == InteractionState::calibration);  // which way it goes is not known yet
  const Point along = (end - start).normalized(), left(-along.y(), along.x());
  CHECK(settle(start + 0.002 * along, -0.002).state == InteractionState::writing);
  settle(start + 0.01 * along + 0.003 * left, -0.002);
  CHECK(renderer.last().state == InteractionState::writing);
  const Point expected =
      -renderer.options().guidance.stiffness * 0.003 * left;  // eq. (8), with attraction factor and guidance weight 1
  CHECK(renderer.last().force.isApprox(Vector3d(expected.x(), expected.y(), 0.002 * renderer.options().paper.stiffness),
                                       1e-9));
  CHECK(renderer.last().pen_tip.z() == 0.0);
}

TEST_CASE("a pen that moves back along a stroke meets resistance, Fig. 4", "[render]") {
  RendererOptions options;
  options.guidance.wrong_way_stiffness = 200.0;
  options.guidance.wrong_way_limit = 1.0;
  options.guidance.wrong_way_slack = 0.05;  // 2 mm
  HapticRenderer renderer = renderer_of(U"三", options);
  ScriptedPen pen(renderer);
  pen.speed = 0.02;  // the guidance has faded in before the first check
  const Stroke first = strokes(renderer.page()[0].character)[0];
  const Point start = renderer.page()[0].placement.to_page(first.control_points[0]);
  const Point end = renderer.page()[0].placement.to_page(first.control_points[1]);
  const Point along = (end - start).normalized();
  pen.go(at(start, 0.005));
  pen.go(at(start, -0.001));
  pen.go(at(start + 0.015 * along, -0.001));
  CHECK(renderer.last().wrong_way == Point(0, 0));
  pen.go(at(start + 0.0135 * along, -0.001));
  CHECK(renderer.last().wrong_way == Point(0, 0));  // within the dead band of 2 mm
  pen.go(at(start + 0.010 * along, -0.001));
  CHECK(renderer.last().wrong_way.isApprox(200.0 * 0.003 * along, 1e-6));
  pen.go(at(start + 0.002 * along, -0.001));
  CHECK(renderer.last().wrong_way.isApprox(1.0 * along, 1e-6));  // its limit
}

TEST_CASE("a moved renderer continues, and restart begins the page again", "[render]") {
  HapticRenderer first = renderer_of(U"三");
  {
    ScriptedPen pen(first);
    pen.write(path_of(strokes(first.page()[0].character)[0], first.page()[0].placement, 1e-4));
  }
  HapticRenderer renderer = std::move(first);
  first = renderer_of(U"永");  // reuses the moved-from object
  ScriptedPen pen(renderer);
  const auto all = strokes(renderer.page()[0].character);
  pen.write(path_of(all[1], renderer.page()[0].placement, 1e-4));
  CHECK(renderer.last().stroke == 2);
  renderer.restart();
  CHECK(renderer.last().stroke == 0);
  CHECK(renderer.last().force == Vector3d(0, 0, 0));
  CHECK(renderer.last().state == InteractionState::separation);
  ScriptedPen again(renderer);
  again.write(renderer.page()[0]);
  CHECK(renderer.last().character == 1);
}

TEST_CASE("a million updates do not allocate", "[render]") {
  constexpr int updates = calligraphy_test::sanitized ? 100'000 : 1'000'000;
  HapticRenderer renderer = renderer_of(U"永北");
  const auto path = path_of(strokes(renderer.page()[0].character)[1], renderer.page()[0].placement, 1e-4);
  const std::size_t before = calligraphy_test::allocations();
  DeviceState state;
  for (int i = 0; i < updates; ++i) {
    const Point& point = path[static_cast<std::size_t>(i) % path.size()];
    state.time = i / 1000.0;
    state.position = {point.x(), point.y(), i % 3000 < 2000 ? -0.001 : 0.002};
    renderer.update(state);
  }
  CHECK(calligraphy_test::allocations() == before);
}
