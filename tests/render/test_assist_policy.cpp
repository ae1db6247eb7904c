// Assistance as needed: fades with success, returns with errors (Emken, Bobrow and Reinkensmeyer 2005).
#include "../catch.hpp"

#include <cmath>
#include <vector>

#include <calligraphy/render/assist_policy.hpp>

#include "../scripted_pen.hpp"

using namespace calligraphy;
using calligraphy_test::beside;
using calligraphy_test::path_of;
using calligraphy_test::placed;
using calligraphy_test::ScriptedPen;
using calligraphy_test::test_device;

namespace {

RendererOptions with_assistance() {
  RendererOptions options;
  options.guidance.assist.enabled = true;
  return options;
}

/// Assistance after each stroke of a character, written with an `offset` [m].
std::vector<double> assistance_after_strokes(HapticRenderer& renderer, double offset) {
  ScriptedPen pen(renderer);
  std::vector<double> assistance;
  pen.on_tick = [&](const HapticTick& tick) {
    constexpr TickEvent ends = TickEvent::stroke_finished | TickEvent::stroke_abandoned;
    if (has_event(tick.events, ends)) assistance.push_back(tick.assistance);
  };
  pen.write(renderer.page()[0], offset);
  return assistance;
}

}  // namespace

TEST_CASE("with perfect strokes assistance decays as retention^n, down to min_assistance", "[render]") {
  AssistPolicy policy;
  for (const double retention : {0.0, 0.5, 0.8, 1.0}) {
    policy.retention = retention;
    double assistance = 1.0;
    for (int n = 1; n <= 30; ++n) {
      assistance = policy.next(assistance, 0.0);
      CHECK(assistance == Approx(std::max(policy.min_assistance, std::pow(retention, n))));
    }
  }
}

TEST_CASE("with a constant error e assistance converges to e over full_assistance_error, from either side",
          "[render]") {
  const AssistPolicy policy;
  for (const double error : {0.01, 0.025, 0.045}) {
    for (const double from : {policy.min_assistance, 1.0}) {
      double assistance = from;
      for (int n = 0; n < 200; ++n) assistance = policy.next(assistance, error);
      CHECK(assistance == Approx(error / policy.full_assistance_error));
    }
  }
}

TEST_CASE("assistance returns to full when errors grow, and stays within its bounds", "[render]") {
  const AssistPolicy policy;
  double assistance = policy.min_assistance;
  double last = assistance;
  for (int n = 0; n < 30; ++n) {
    assistance = policy.next(assistance, 2.0 * policy.full_assistance_error);
    CHECK(assistance >= last);
    last = assistance;
  }
  CHECK(assistance == 1.0);
  for (const double error : {0.0, 1e-300, 1.0, 1e300}) {
    for (const double from : {policy.min_assistance, 0.5, 1.0}) {
      CHECK(policy.next(from, error) >= policy.min_assistance);
      CHECK(policy.next(from, error) <= 1.0);
    }
  }
}

TEST_CASE("over well-written strokes assistance decays, to about retention^n after the n-th", "[render]") {
  HapticRenderer renderer({placed(U'永')}, {}, test_device(), with_assistance());
  const std::vector<double> assistance = assistance_after_strokes(renderer, 0.0);
  REQUIRE(assistance.size() == 5);
  double before = 1.0;
  for (std::size_t n = 0; n < assistance.size(); ++n) {
    CHECK(assistance[n] < before);
    // The path of the test cuts corners slightly, and the closest point jumps ahead near them: an error, however small.
    CHECK(assistance[n] == Approx(std::pow(0.8, static_cast<double>(n + 1))).margin(0.05));
    before = assistance[n];
  }
}

TEST_CASE("a stroke written with an offset leaves the assistance that its error implies", "[render]") {
  // 三: straight strokes, so the lateral error is the offset everywhere.
  for (const double offset : {0.001, -0.0015}) {
    HapticRenderer renderer({placed(U'三')}, {}, test_device(), with_assistance());
    const std::vector<double> assistance = assistance_after_strokes(renderer, offset);
    REQUIRE(assistance.size() == 3);
    double expected = 1.0;
    for (const double found : assistance) {
      expected = 0.8 * expected + 0.2 * std::abs(offset) / 0.002;
      CHECK(found == Approx(expected).epsilon(0.01));
    }
  }
}

TEST_CASE("bad and abandoned strokes restore assistance", "[render]") {
  HapticRenderer renderer({placed(U'三')}, {}, test_device(), with_assistance());
  const auto all = strokes(renderer.page()[0].character);
  const Placement place = renderer.page()[0].placement;
  ScriptedPen pen(renderer);
  pen.write(path_of(all[0], place, 1e-4));
  pen.write(path_of(all[1], place, 1e-4));
  const double little = renderer.last().assistance;
  CHECK(little < 0.7);
  std::vector<Point> half = path_of(all[2], place, 1e-4);
  half.resize(half.size() / 2);
  pen.write(half);
  CHECK(has_event(renderer.last().events, TickEvent::stroke_abandoned) == false);  // it was, some ticks ago
  CHECK(renderer.last().stroke == 2);
  const double more = renderer.last().assistance;
  CHECK(more == Approx(0.8 * little + 0.2));  // as with full_assistance_error
  pen.write(beside(path_of(all[2], place, 1e-4), 0.005));
  CHECK(renderer.last().assistance > more);
}

TEST_CASE("assistance scales the guidance and no other force", "[render]") {
  HapticRenderer with({placed(U'三')}, {}, test_device(), with_assistance());
  HapticRenderer without({placed(U'三')}, {}, test_device());
  const auto all = strokes(with.page()[0].character);
  const auto second = beside(path_of(all[1], with.page()[0].placement, 1e-4), 0.003);
  ScriptedPen pen(with), other(without);
  int compared = 0;
  for (ScriptedPen* each : {&pen, &other}) each->write(path_of(all[0], with.page()[0].placement, 1e-4));
  const double assistance = with.last().assistance;
  CHECK(assistance < 0.9);
  pen.on_tick = [&](const HapticTick& tick) {
    const HapticTick& full = without.last();
    if (tick.state != InteractionState::writing) return;
    CHECK((tick.attraction - assistance * full.attraction).norm() <= 1e-12);
    CHECK(tick.normal == full.normal);
    CHECK(tick.wrong_way == full.wrong_way);
    compared += full.attraction.norm() > 0.5;
  };
  for (ScriptedPen* each : {&other, &pen}) each->go({second.front().x(), second.front().y(), 0.005});
  for (const Point& point : second) {
    for (ScriptedPen* each : {&other, &pen}) each->at({point.x(), point.y(), -0.001});
  }
  CHECK(compared > 50);
}

TEST_CASE("without the policy assistance stays full, however the strokes are written", "[render]") {
  HapticRenderer renderer({placed(U'永')}, {}, test_device());
  for (const double assistance : assistance_after_strokes(renderer, 0.002)) CHECK(assistance == 1.0);
  CHECK(renderer.last().assistance == 1.0);
}

TEST_CASE("restart restores full assistance", "[render]") {
  HapticRenderer renderer({placed(U'三')}, {}, test_device(), with_assistance());
  assistance_after_strokes(renderer, 0.0);
  CHECK(renderer.last().assistance < 0.6);
  renderer.restart();
  CHECK(renderer.last().assistance == 1.0);
}
