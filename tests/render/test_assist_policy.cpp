// Help as needed: fades with success, returns with errors (Emken, Bobrow and Reinkensmeyer 2005).
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

RendererOptions with_help() {
  RendererOptions options;
  options.assist.enabled = true;
  return options;
}

/// The help after each stroke of a character, written `offset` beside itself [m].
std::vector<double> help_after_strokes(HapticRenderer& renderer, double offset) {
  ScriptedPen pen(renderer);
  std::vector<double> help;
  pen.on_tick = [&](const HapticTick& tick) {
    constexpr TickEvent ends = TickEvent::stroke_finished | TickEvent::stroke_abandoned;
    if (has(tick.events, ends)) help.push_back(tick.help);
  };
  pen.write(renderer.page()[0], offset);
  return help;
}

}  // namespace

TEST_CASE("with perfect writing help decays as retention^n, down to the least", "[render]") {
  AssistPolicy policy;
  for (const double retention : {0.0, 0.5, 0.8, 1.0}) {
    policy.retention = retention;
    double help = 1.0;
    for (int n = 1; n <= 30; ++n) {
      help = policy.next(help, 0.0);
      CHECK(help == Approx(std::max(policy.least, std::pow(retention, n))));
    }
  }
}

TEST_CASE("with an error held at e help settles at e over full_help_error, from either side", "[render]") {
  const AssistPolicy policy;
  for (const double error : {0.0004, 0.001, 0.0018}) {
    for (const double from : {policy.least, 1.0}) {
      double help = from;
      for (int n = 0; n < 200; ++n) help = policy.next(help, error);
      CHECK(help == Approx(error / policy.full_help_error));
    }
  }
}

TEST_CASE("help returns to full when errors grow, and never leaves its bounds", "[render]") {
  const AssistPolicy policy;
  double help = policy.least;
  double last = help;
  for (int n = 0; n < 30; ++n) {
    help = policy.next(help, 2.0 * policy.full_help_error);
    CHECK(help >= last);
    last = help;
  }
  CHECK(help == 1.0);
  for (const double error : {0.0, 1e-300, 1.0, 1e300}) {
    for (const double from : {policy.least, 0.5, 1.0}) {
      CHECK(policy.next(from, error) >= policy.least);
      CHECK(policy.next(from, error) <= 1.0);
    }
  }
}

TEST_CASE("over well-written strokes help falls, the n-th leaving about retention^n", "[render]") {
  HapticRenderer renderer({placed(U'永')}, {}, test_device(), with_help());
  const std::vector<double> help = help_after_strokes(renderer, 0.0);
  REQUIRE(help.size() == 5);
  double before = 1.0;
  for (std::size_t n = 0; n < help.size(); ++n) {
    CHECK(help[n] < before);
    // The path of the test cuts corners a little, and the foot leaps ahead near them: an error, however small.
    CHECK(help[n] == Approx(std::pow(0.8, static_cast<double>(n + 1))).margin(0.05));
    before = help[n];
  }
}

TEST_CASE("a stroke written beside itself leaves the help that its error is worth", "[render]") {
  // 三: straight strokes, so that the lateral error is the offset all along.
  for (const double offset : {0.001, -0.0015}) {
    HapticRenderer renderer({placed(U'三')}, {}, test_device(), with_help());
    const std::vector<double> help = help_after_strokes(renderer, offset);
    REQUIRE(help.size() == 3);
    double expected = 1.0;
    for (const double found : help) {
      expected = 0.8 * expected + 0.2 * std::abs(offset) / 0.002;
      CHECK(found == Approx(expected).epsilon(0.01));
    }
  }
}

TEST_CASE("bad and abandoned strokes bring help back", "[render]") {
  HapticRenderer renderer({placed(U'三')}, {}, test_device(), with_help());
  const auto all = strokes(renderer.page()[0].character);
  const Placement place = renderer.page()[0].placement;
  ScriptedPen pen(renderer);
  pen.write(path_of(all[0], place, 1e-4));
  pen.write(path_of(all[1], place, 1e-4));
  const double little = renderer.last().help;
  CHECK(little < 0.7);
  std::vector<Point> half = path_of(all[2], place, 1e-4);
  half.resize(half.size() / 2);
  pen.write(half);
  CHECK(has(renderer.last().events, TickEvent::stroke_abandoned) == false);  // it was, some ticks ago
  CHECK(renderer.last().stroke == 2);
  const double more = renderer.last().help;
  CHECK(more == Approx(0.8 * little + 0.2));  // as with full_help_error
  pen.write(beside(path_of(all[2], place, 1e-4), 0.005));
  CHECK(renderer.last().help > more);
}

TEST_CASE("the guidance is scaled by the help, the other forces are not", "[render]") {
  HapticRenderer with({placed(U'三')}, {}, test_device(), with_help());
  HapticRenderer without({placed(U'三')}, {}, test_device());
  const auto all = strokes(with.page()[0].character);
  const auto second = beside(path_of(all[1], with.page()[0].placement, 1e-4), 0.003);
  ScriptedPen pen(with), other(without);
  int compared = 0;
  for (ScriptedPen* each : {&pen, &other}) each->write(path_of(all[0], with.page()[0].placement, 1e-4));
  const double help = with.last().help;
  CHECK(help < 0.9);
  pen.on_tick = [&](const HapticTick& tick) {
    const HapticTick& full = without.last();
    if (tick.state != InteractionState::writing) return;
    CHECK((tick.attraction - help * full.attraction).norm() <= 1e-12);
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

TEST_CASE("without the policy help stays full, however the strokes are written", "[render]") {
  HapticRenderer renderer({placed(U'永')}, {}, test_device());
  for (const double help : help_after_strokes(renderer, 0.002)) CHECK(help == 1.0);
  CHECK(renderer.last().help == 1.0);
}

TEST_CASE("restart gives full help again", "[render]") {
  HapticRenderer renderer({placed(U'三')}, {}, test_device(), with_help());
  help_after_strokes(renderer, 0.0);
  CHECK(renderer.last().help < 0.6);
  renderer.restart();
  CHECK(renderer.last().help == 1.0);
}
