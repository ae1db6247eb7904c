// A stroke that is passed over, as a page does for a writer who cannot go on.
#include "../catch.hpp"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "../allocation_counter.hpp"
#include "../scripted_pen.hpp"

namespace skip_tests {

using namespace calligraphy;
using calligraphy_test::at;
using calligraphy_test::path_of;
using calligraphy_test::placed;
using calligraphy_test::ScriptedPen;
using calligraphy_test::test_device;

namespace {

HapticRenderer renderer_of(std::vector<PlacedCharacter> page, const RendererOptions& options = {}) {
  return {std::move(page), {}, test_device(), options};
}

RendererOptions sliding() {
  RendererOptions options;
  options.contact.lift_between_strokes = false;
  options.guidance.to_start = true;
  return options;
}

std::vector<Point> path(const HapticRenderer& renderer, std::size_t stroke, std::size_t character = 0) {
  const PlacedCharacter& of = renderer.page()[character];
  return path_of(strokes(of.character)[stroke], of.placement, 1e-4);
}

/// Writes strokes of a renderer's first character or skips them: "ws" writes the first and skips the second. Says which
/// strokes were finished.
std::string finished_by(HapticRenderer& renderer, const std::string& what) {
  std::string finished;
  ScriptedPen pen(renderer);
  pen.on_tick = [&](const HapticTick& tick) {
    if (has_event(tick.events, TickEvent::stroke_finished)) finished += std::to_string(tick.stroke) + " ";
    if (has_event(tick.events, TickEvent::character_finished)) finished += "character ";
    if (has_event(tick.events, TickEvent::page_finished)) finished += "page ";
  };
  for (std::size_t stroke = 0; stroke < what.size(); ++stroke) {
    if (what[stroke] == 's') {
      CHECK(renderer.skip_stroke());
      pen.go(at(path(renderer, stroke).front(), 0.005));
    } else {
      pen.write(path(renderer, stroke));
    }
  }
  return finished;
}

/// The character without one of its strokes.
PlacedCharacter without(PlacedCharacter placed, std::size_t stroke) {
  std::vector<StrokeInput> inputs;
  for (const Stroke& stroke : strokes(placed.character)) inputs.push_back(input_of(stroke));
  inputs.erase(inputs.begin() + static_cast<std::ptrdiff_t>(stroke));
  placed.character = make_character(placed.character.code, inputs, placed.character.curve_degree);
  return placed;
}

}  // namespace

TEST_CASE("the first, a middle and the last stroke are skipped, and the others are finished", "[render]") {
  for (const RendererOptions& options : {RendererOptions(), sliding()}) {
    const bool lifts = options.contact.lift_between_strokes;
    const auto written = [&](const std::string& what) {
      HapticRenderer renderer = renderer_of({placed(U'三')}, options);
      const std::string result = finished_by(renderer, what);
      CHECK(renderer.last().character == 1);
      CHECK(renderer.last().stroke == 0);
      CHECK_FALSE(renderer.skip_stroke());
      return result;
    };
    const std::string last = lifts ? "3 character page " : "0 character page ";
    CHECK(written("www") == "1 2 " + last);
    CHECK(written("sww") == "2 " + last);
    CHECK(written("wsw") == "1 " + last);
    CHECK(written("wws") == "1 2 ");
    CHECK(written("sss").empty());
  }
}

TEST_CASE("past the last stroke of a character the next one is due", "[render]") {
  HapticRenderer renderer = renderer_of({placed(U'十'), placed(U'一', {0.08, 0.02})});
  ScriptedPen pen(renderer);
  pen.go(at(path(renderer, 0).front(), 0.005));
  CHECK(renderer.skip_stroke());
  CHECK(renderer.last().stroke == 0);  // until the next update
  CHECK(renderer.skip_stroke());
  pen.go(at(path(renderer, 0).front(), 0.005));
  CHECK(renderer.last().character == 1);
  CHECK(renderer.last().stroke == 0);
  pen.write(path(renderer, 0, 1));
  CHECK(renderer.last().character == 2);
  CHECK_FALSE(renderer.skip_stroke());
  renderer.restart();
  CHECK(renderer.skip_stroke());
}

TEST_CASE("a stroke is made due again, and a renderer takes over from another", "[render]") {
  HapticRenderer renderer = renderer_of({placed(U'三'), placed(U'一', {0.08, 0.02})});
  ScriptedPen pen(renderer);
  pen.write(path(renderer, 0));
  pen.write(path(renderer, 1));
  CHECK(renderer.set_due(0, 0));
  for (std::size_t stroke = 0; stroke < 3; ++stroke) {
    CHECK(renderer.last().character == 0);
    pen.write(path(renderer, stroke));
  }
  CHECK(renderer.last().character == 1);
  CHECK(renderer.set_due(0, 2));
  pen.on_tick = [&](const HapticTick& tick) {
    if (tick.state == InteractionState::writing) CHECK_FALSE(renderer.set_due(0, 0));
    if (tick.state != InteractionState::separation) CHECK_FALSE(renderer.set_due(1, 0));
  };
  pen.write(path(renderer, 2));
  CHECK(renderer.last().character == 1);
  for (const auto& [character, stroke] : {std::pair(-1, 0), {0, -1}, {0, 3}, {1, 1}, {2, 1}, {3, 0}}) {
    CHECK_FALSE(renderer.set_due(character, stroke));
  }
  CHECK(renderer.set_due(2, 0));
  CHECK_FALSE(renderer.skip_stroke());
}

TEST_CASE("a stroke that is being written is not skipped", "[render]") {
  HapticRenderer renderer = renderer_of({placed(U'三')}), other = renderer_of({placed(U'三')});
  std::vector<Eigen::Vector3d> forces, expected;
  int refused = 0, skipped = 0;
  for (HapticRenderer* each : {&renderer, &other}) {
    ScriptedPen pen(*each);
    pen.on_tick = [&](const HapticTick& tick) {
      (each == &renderer ? forces : expected).push_back(tick.force);
      if (each == &other || tick.state != InteractionState::writing) return;
      (renderer.skip_stroke() ? skipped : refused) += 1;
    };
    pen.write(path(*each, 0));
  }
  CHECK(refused > 100);
  CHECK(skipped == 0);
  CHECK(forces == expected);
  CHECK(renderer.last().stroke == 1);
}

TEST_CASE("the last stroke of a character was finished: until the pen is lifted there is none to skip", "[render]") {
  HapticRenderer renderer = renderer_of({placed(U'一'), placed(U'一', {0.08, 0.02})});
  ScriptedPen pen(renderer);
  const auto way = path(renderer, 0);
  pen.go(at(way.front(), 0.005));
  for (const Point& point : way) pen.go(at(point, -0.001));
  for (int i = 0; i < 25; ++i) pen.at(at(way.back(), -0.001));
  REQUIRE(renderer.last().stroke == 1);
  CHECK_FALSE(renderer.skip_stroke());
  pen.go(at(way.back(), 0.005));
  CHECK(renderer.last().character == 1);
  CHECK(renderer.skip_stroke());
}

TEST_CASE("a stroke skipped in the air leaves the forces of a character that does not have it", "[render]") {
  const PlacedCharacter whole = placed(U'永');
  RendererOptions options;
  options.contact.box_margin = 1.0;  // the boxes differ, but the pen is in both
  for (const std::size_t skipped : {0u, 1u, 3u}) {
    HapticRenderer renderer = renderer_of({whole}, options), expected = renderer_of({without(whole, skipped)}, options);
    std::vector<Eigen::Vector3d> forces, expected_forces;
    std::vector<TickEvent> events, expected_events;
    ScriptedPen pen(renderer), other(expected);
    pen.on_tick = [&](const HapticTick& tick) { forces.push_back(tick.force), events.push_back(tick.events); };
    other.on_tick = [&](const HapticTick& tick) {
      expected_forces.push_back(tick.force), expected_events.push_back(tick.events);
    };
    for (std::size_t stroke = 0; stroke < 5; ++stroke) {
      if (stroke == skipped) {
        CHECK(renderer.skip_stroke());
        continue;
      }
      const auto way = calligraphy_test::beside(path(renderer, stroke), 0.001);
      pen.write(way);
      other.write(way);
    }
    CHECK(expected.last().character == 1);
    CHECK(forces == expected_forces);
    CHECK(events == expected_events);
  }
}

TEST_CASE("guidance lets go of a pen on the paper when its stroke is skipped, until it is lifted", "[render]") {
  for (const RendererOptions& options : {RendererOptions(), sliding()}) {
    for (const bool is_last : {false, true}) {
      HapticRenderer renderer = renderer_of({placed(U'二'), placed(U'二', {0.08, 0.02})}, options);
      ScriptedPen pen(renderer);
      if (is_last) pen.write(path(renderer, 0));
      const std::size_t due = is_last ? 1 : 0;
      const Point start = path(renderer, due).front(), beside = start + Point(-0.0005, 0.001);
      pen.go(at(beside, 0.005));
      pen.go(at(beside, -0.001));
      for (int i = 0; i < 300; ++i) pen.at(at(beside, -0.001));
      REQUIRE(renderer.last().attraction.norm() > 0.05);
      const double paper = renderer.last().page_force.z();
      REQUIRE(renderer.skip_stroke());
      pen.max_step = 0.0;
      for (int i = 0; i < 500; ++i) pen.at(at(beside, -0.001));
      CHECK(renderer.last().stroke == static_cast<int>(due) + 1);
      CHECK(renderer.last().hint == WritingHint::lift_first);
      CHECK(renderer.last().attraction == Point(0, 0));
      CHECK(renderer.last().page_force.head<2>().norm() < 1e-9);
      CHECK(pen.max_step < 0.01);                                           // [N]: it fades
      CHECK(renderer.last().page_force.z() == Approx(paper).margin(1e-6));  // the paper does not give way
      pen.write(path(renderer, 1 - due, is_last ? 1 : 0));
      CHECK(renderer.last().stroke == (is_last ? 1 : 0));
      CHECK(renderer.last().character == 1);
    }
  }
}

TEST_CASE("skipping does not allocate", "[render]") {
  HapticRenderer renderer = renderer_of({placed(U'永'), placed(U'北', {0.08, 0.02})});
  const std::size_t before = calligraphy_test::allocations();
  int skipped = 0;
  for (int i = 0; i < 20; ++i) skipped += renderer.skip_stroke();
  CHECK(calligraphy_test::allocations() == before);
  CHECK(skipped == 10);
}

}  // namespace skip_tests
