// Guidance laws of others: GuidanceLaw and the functions that stand for one.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/device_profiles.hpp>

#include "../allocation_counter.hpp"
#include "../scripted_pen.hpp"

using namespace calligraphy;
using calligraphy_test::placed;
using calligraphy_test::ScriptedPen;
using calligraphy_test::test_device;
using Catch::Matchers::Contains;

namespace {

Capabilities weighed_device() {
  Capabilities device = test_device();
  device.apparent_mass = 0.05;
  return device;
}

HapticRenderer renderer_of(char32_t code, GuidanceFactory force, RendererOptions options = {},
                           const Capabilities& device = weighed_device()) {
  options.guidance.force = std::move(force);
  return {{placed(code)}, {}, device, options};
}

/// Of a pen that writes 永 beside its strokes.
std::vector<HapticTick> ticks_of(HapticRenderer renderer) {
  std::vector<HapticTick> ticks;
  ScriptedPen pen(renderer);
  pen.on_tick = [&](const HapticTick& tick) { ticks.push_back(tick); };
  pen.write(renderer.page()[0], 0.002);
  return ticks;
}

GuidanceTraits stated(double stiffness, double power = 0.0) { return {.stiffness = stiffness, .power = power}; }

/// Calls a function with each input.
struct Watched : GuidanceLaw {
  struct Seen {
    std::vector<const ActiveStroke*> begun;
    std::vector<GuidanceInput> inputs;
  };
  explicit Watched(Seen& seen) : seen(seen) {}
  void begin(const ActiveStroke& stroke) override { seen.begun.push_back(&stroke); }
  GuidanceTerms force(const GuidanceInput& input) override {
    seen.inputs.push_back(input);
    return {};
  }
  Seen& seen;
};

/// 一 is a straight line from left to right.
void press_beside_start(ScriptedPen& pen, const HapticRenderer& renderer) {
  const Point start = strokes(renderer.page()[0].character)[0].control_points.front();
  const Point tip = renderer.page()[0].placement.to_page(start) + Point(0.0, 0.001);
  pen.go({tip.x(), tip.y(), 0.005});
  pen.go({tip.x(), tip.y(), -0.001});
  pen.go({tip.x() + 0.015, tip.y(), -0.001});
}

}  // namespace

TEST_CASE("the linear law, written as a function of its input, gives the same forces to the last bit", "[render]") {
  const auto ours = ticks_of(renderer_of(U'永', linear_guidance));
  const auto same = ticks_of(renderer_of(U'永', {[](const GuidanceInput& in) -> Point {
                                                   return in.stiffness * in.share * (in.target - in.tip);
                                                 },
                                                 stated(600.0)}));
  REQUIRE(ours.size() == same.size());
  bool alike = true;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    alike = alike && ours[i].force == same[i].force && ours[i].events == same[i].events;
  }
  CHECK(alike);
}

TEST_CASE("a law is told where the pen is, and of each attempt before it is asked for a force", "[render]") {
  Watched::Seen seen;
  HapticRenderer renderer = renderer_of(U'一', Watched(seen));
  ScriptedPen pen(renderer);
  int attempts = 0;
  for (int attempt = 0; attempt < 2; ++attempt) {
    press_beside_start(pen, renderer);
    const HapticTick& tick = renderer.last();
    REQUIRE(seen.begun.size() == static_cast<std::size_t>(++attempts));
    const ActiveStroke& stroke = *seen.begun.back();
    const GuidanceInput& in = seen.inputs.back();
    CHECK(in.writing);
    CHECK(in.tip == tick.pen_tip.head<2>());
    CHECK(in.tip + in.way == in.target);
    CHECK(in.nearest == tick.contact.closest.point);
    CHECK(in.distance == Approx((in.tip - in.nearest).norm()));
    CHECK(in.arc + in.left == Approx(stroke.length()));
    CHECK((stroke.at(in.arc).point - in.nearest).norm() < 1e-6);
    CHECK(in.curvature == Approx(stroke.at(in.arc).curvature));
    CHECK(in.feature == stroke.end());
    CHECK(in.to_start == tick.to_start);
    CHECK(in.depth == Approx(0.001));
    CHECK(in.em == 0.04);
    CHECK(in.dt == 0.001);
    CHECK(in.velocity.x() == Approx(0.1).margin(0.01));
    CHECK(in.max_stiffness >= in.stiffness);
    const GuidanceInput& first = seen.inputs.front();
    CHECK_FALSE(first.writing);
    CHECK(first.nearest == stroke.start());
    CHECK((first.arc == 0.0 && first.left == Approx(stroke.length())));
    pen.go({in.tip.x(), in.tip.y(), 0.005});
  }
  pen.go({0.15, 0.01, 0.005});
  pen.go({0.15, 0.01, -0.001});  // another place: nobody is led
  CHECK(seen.begun.size() == 2);
}

TEST_CASE("each renderer has a law of its own", "[render]") {
  std::vector<int> asked;
  const GuidanceFactory counting([&asked, own = 0](const GuidanceInput&) mutable -> Point {
    asked.push_back(++own);
    return Point::Zero();
  });
  for (int i = 0; i < 2; ++i) {
    asked.clear();
    HapticRenderer renderer = renderer_of(U'一', counting);
    ScriptedPen pen(renderer);
    press_beside_start(pen, renderer);
    REQUIRE(!asked.empty());
    CHECK(asked.front() == 1);
  }
}

TEST_CASE("a law that throws, or whose force is not finite, is no force and a status, until it answers again",
          "[render]") {
  struct Broken {
    bool throws;
    int* asked;
    GuidanceTerms operator()(const GuidanceInput& in) const {
      const bool is_broken = ++*asked >= 100 && *asked < 130;
      if (is_broken && throws) throw std::runtime_error("out of ideas");
      const double nothing = is_broken ? std::numeric_limits<double>::quiet_NaN() : 0.0;
      return {300.0 * in.way, guidance_damper(in, in.share), nothing};
    }
  };
  for (const bool throws : {true, false}) {
    int asked = 0, bad = 0;
    HapticRenderer renderer = renderer_of(U'一', {Broken{throws, &asked}, stated(300.0)});
    ScriptedPen pen(renderer);
    std::vector<double> forces;  // from the first bad tick on
    pen.on_tick = [&](const HapticTick& tick) {
      bad += tick.status == TickStatus::bad_law;
      if (bad > 0) forces.push_back(tick.force.norm());
    };
    press_beside_start(pen, renderer);
    CAPTURE(throws);
    CHECK(bad == 30);
    REQUIRE(forces.size() > 30);
    CHECK(forces[20] == 0.0);
    CHECK(forces.back() > 0.25);
    CHECK(pen.finite);
    CHECK(pen.max_unexplained <= 1e-12);
    CHECK(static_cast<bool>(renderer.law_error()) == throws);
    if (throws) CHECK_THROWS_WITH(std::rethrow_exception(renderer.law_error()), "out of ideas");
    renderer.restart();
    CHECK_FALSE(renderer.law_error());
  }
}

TEST_CASE("a law that is stiffer than the device stands is refused, or its spring is scaled down", "[render]") {
  const auto stiff = [](const GuidanceInput& in) -> Point { return 5000.0 * in.way; };
  RendererOptions options;
  CHECK_THROWS_WITH(renderer_of(U'一', {stiff, {.name = "stiff", .stiffness = 5000.0}}, options),
                    Contains("guidance law \"stiff\": stiffness = 5000 N/m is above"));
  options.stiffness_check = StiffnessCheck::clip;
  HapticRenderer renderer = renderer_of(U'一', {stiff, stated(5000.0)}, options);
  REQUIRE(renderer.clipped().size() == 1);
  ScriptedPen pen(renderer);
  press_beside_start(pen, renderer);
  const double limit = max_guidance_stiffness(renderer.options(), weighed_device());
  CHECK(renderer.last().attraction.norm() == Approx(renderer.last().contact.closest.distance * limit));
}

TEST_CASE("a law of unknown stiffness, or that leads the pen on, has a budget of energy or no real device",
          "[render]") {
  const auto law = [](const GuidanceInput&) -> Point { return Point::Zero(); };
  const double inf = std::numeric_limits<double>::infinity();
  Capabilities unweighed = test_device(), real = test_device();
  real.simulated = false;
  CHECK(renderer_of(U'一', law).options().energy.budget == 0.1);
  CHECK(renderer_of(U'一', {law, stated(300.0, 0.01)}).options().energy.budget == 0.1);
  CHECK(renderer_of(U'一', {law, stated(300.0)}).options().energy.budget == inf);
  CHECK(renderer_of(U'一', law, {}, unweighed).options().energy.budget == inf);
  CHECK_THROWS_WITH(renderer_of(U'一', law, {}, real), Contains("states no stiffness") && Contains("apparent mass"));
  CHECK_THROWS_WITH(renderer_of(U'一', {law, stated(300.0, 0.01)}, {}, real), Contains("states a power"));
  CHECK_NOTHROW(renderer_of(U'一', {law, stated(300.0)}, {}, real));
  CHECK_THROWS_WITH(renderer_of(U'一', {law, stated(300.0, 11.0)}), Contains("power = 11 W"));
  CHECK_THROWS_WITH(renderer_of(U'一', {law, stated(-1.0)}), Contains("stiffness = -1 N/m"));
  CHECK_THROWS_WITH(renderer_of(U'一', [](const GuidanceSetup&) { return std::unique_ptr<GuidanceLaw>(); }),
                    Contains("made no law"));
}

TEST_CASE("a law that pulls a pen along gives the hand no more than the budget and its power", "[render]") {
  const auto leading = [](const GuidanceInput& in) -> Point { return in.writing ? Point(3.0 * in.tangent) : in.way; };
  for (const double power : {0.0, 0.05}) {
    RendererOptions options;
    options.guidance.force = {leading, stated(300.0, power)};
    options.energy.budget = 0.1;
    HapticRenderer renderer({placed(U'一', {0.02, 0.02}, 0.2)}, {}, weighed_device(), options);
    ScriptedPen pen(renderer);
    pen.speed = 0.05;
    double given = 0.0, most = 0.0, time = 0.0;  // by an account of its own [J], [s]
    Eigen::Vector3d force(0, 0, 0), place(0, 0, 0);
    pen.on_tick = [&](const HapticTick& tick) {
      given += force.dot(tick.device_point - place);
      force = tick.force;
      place = tick.device_point;
      time += 0.001;
      most = std::max(most, given - power * time);
    };
    pen.write(calligraphy_test::path_of(strokes(renderer.page()[0].character)[0], renderer.page()[0].placement, 1e-4));
    CAPTURE(power, time);
    CHECK(most <= 0.1);
    CHECK(given > 0.06 + power * 1.5);
  }
}

TEST_CASE("at a sample that jumps an own law steps and peaks no higher than the built-in one", "[render]") {
  const auto channel = [](const GuidanceInput& in) -> Point {
    return in.share * in.stiffness * (1.0 - 0.001 / std::max(0.001, in.way.norm())) * in.way;
  };
  const auto spring = [](const GuidanceInput& in) -> Point { return in.share * in.stiffness * in.way; };
  const Capabilities device = device_profile("desktop");  // 7.9 N
  struct Jump {
    double step, peak;
  };
  const auto jump = [&](GuidanceFactory force, double max_acceleration) {
    RendererOptions options = RendererOptions::for_device(device);
    options.guidance.force = std::move(force);
    options.limits.max_acceleration = max_acceleration;
    HapticRenderer renderer({placed(U'一')}, {}, device, options);
    ScriptedPen pen(renderer);
    press_beside_start(pen, renderer);
    const Eigen::Vector3d rest = renderer.last().device_point;
    for (int tick = 0; tick < 400; ++tick) pen.at(rest);
    pen.max_step = pen.max_force = 0.0;
    for (int tick = 1; tick <= 400; ++tick) pen.at(rest + Eigen::Vector3d(0.0, 0.002 * std::min(tick, 3), 0.0));
    return Jump{pen.max_step, pen.max_force};
  };
  for (const double max_acceleration : {100.0, std::numeric_limits<double>::infinity()}) {
    const Jump built_in = jump(linear_guidance, max_acceleration);
    const double stiffness = RendererOptions::for_device(device).guidance.stiffness;
    for (const GuidanceFactory& own : {GuidanceFactory(channel, stated(stiffness)), GuidanceFactory(channel),
                                       GuidanceFactory(spring, stated(stiffness)), GuidanceFactory(spring)}) {
      const Jump felt = jump(own, max_acceleration);
      CAPTURE(max_acceleration, built_in.step, built_in.peak, felt.step, felt.peak);
      CHECK(felt.step <= built_in.step + 1e-9);
      CHECK(felt.peak <= built_in.peak + 1e-3);  // one that states nothing may follow a little faster
    }
  }
}

TEST_CASE("the normal force of a law sets in and is withdrawn in time, and goes on through feature points",
          "[render]") {
  RendererOptions options;
  options.paper.stiffness = options.paper.damping = 0.0;
  const auto up = [](const GuidanceInput&) -> GuidanceTerms { return {{0.0, 0.0}, {0.0, 0.0}, 1.0}; };
  HapticRenderer renderer = renderer_of(U'永', up, options);
  ScriptedPen pen(renderer);
  double before = 0.0, largest = 0.0, least = 1.0;
  pen.on_tick = [&](const HapticTick& tick) {
    largest = std::max(largest, std::abs(tick.normal - before));
    before = tick.normal;
    if (has_event(tick.events, TickEvent::feature_passed)) least = std::min(least, tick.normal);
  };
  pen.speed = 0.03;
  pen.write(renderer.page()[0]);
  CHECK(renderer.last().character == 1);
  CHECK(largest <= 1.5 / 150 + 1e-3);  // the steepest slope of a smooth step in 150 ms
  CHECK(least > 0.9);
}

TEST_CASE("a tick with an own law does not allocate", "[render]") {
  HapticRenderer renderer = renderer_of(U'永', [](const GuidanceInput& in) -> Point { return 300.0 * in.way; });
  ScriptedPen pen(renderer);
  std::size_t before = 0, most = 0;
  pen.on_tick = [&](const HapticTick&) { most = std::max(most, calligraphy_test::allocations() - before); };
  const PlacedCharacter& written = renderer.page()[0];
  const auto path = calligraphy_test::path_of(strokes(written.character)[0], written.placement, 1e-4);
  for (const Point& point : path) {
    before = calligraphy_test::allocations();
    pen.at({point.x(), point.y() + 0.001, -0.001});
  }
  CHECK(most == 0);
}

TEST_CASE("a renderer that was moved from gives no force", "[render]") {
  HapticRenderer renderer = renderer_of(U'一', linear_guidance);
  ScriptedPen pen(renderer);
  press_beside_start(pen, renderer);
  CHECK(renderer.last().force.norm() > 0.1);
  HapticRenderer other = std::move(renderer);
  const HapticTick& tick = renderer.update({});  // NOLINT(bugprone-use-after-move)
  CHECK((tick.force.isZero(0.0) && tick.page_force.isZero(0.0)));
  CHECK(other.last().force.norm() > 0.1);
}
