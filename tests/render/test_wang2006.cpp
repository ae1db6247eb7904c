// Each rule as printed against the default, with the difference that theory predicts.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>

#include "../scripted_pen.hpp"

using namespace calligraphy;
using calligraphy_test::beside;
using calligraphy_test::path_of;
using calligraphy_test::placed;
using calligraphy_test::ScriptedPen;
using calligraphy_test::test_device;
using Eigen::Vector3d;

namespace {

constexpr double stiffness = 400.0;

/// The defaults with the raw force of the springs: no rate limit, no fade-in, no onset, no damping.
RendererOptions direct() {
  RendererOptions options;
  options.paper.stiffness = options.guidance.stiffness = stiffness;
  options.guidance.wrong_way_stiffness = 0.0;
  options.guidance.fade_in = 0.0;
  options.limits.in_plane_rate = options.limits.normal_rate = std::numeric_limits<double>::infinity();
  options.paper.onset = 0.0;
  options.paper.damping = options.guidance.damping = 0.0;
  options.stiffness_check = StiffnessCheck::off;
  return options;
}

const Character line = calligraphy_test::typical_character(1);

/// Maximum step of the in-plane force while the pen writes `path` on the first stroke of `character` [N].
double max_in_plane_step(const Character& character, const std::vector<Point>& path, const RendererOptions& options,
                         double speed = 0.1) {
  HapticRenderer renderer({{character, {{0.02, 0.02}, 0.04}}}, {}, test_device(), options);
  ScriptedPen pen(renderer);
  pen.speed = speed;
  Vector3d last = Vector3d::Zero();
  double largest = 0.0;
  bool was_writing = false;
  pen.go({path.front().x(), path.front().y(), 0.005});
  pen.on_tick = [&](const HapticTick& tick) {
    const bool writing = tick.state == InteractionState::writing;
    if (writing && was_writing) largest = std::max(largest, (tick.page_force - last).head<2>().norm());
    last = tick.page_force;
    was_writing = writing;
  };
  for (const Point& point : path) pen.go({point.x(), point.y(), -0.001});
  return largest;
}

std::vector<Point> page_path(const Character& character, double offset) {
  return beside(path_of(strokes(character)[0], {{0.02, 0.02}, 0.04}, 1e-4), offset);
}

}  // namespace

TEST_CASE("the half disc drops K d before the end of a stroke, the tube does not", "[render]") {
  RendererOptions whole = direct();
  whole.tolerances.coverage = 0.0;
  RendererOptions printed = whole;
  printed.guidance.force = printed_guidance;
  printed.rules = Rules::wang2006;  // the disc ends d^2 / 2L before the stroke
  constexpr double slow = 0.005;
  for (const double deviation : {0.001, 0.002, 0.004}) {
    INFO("deviation " << deviation << " m");
    const std::vector<Point> path = page_path(line, deviation);
    CHECK(max_in_plane_step(line, path, printed, slow) == Approx(stiffness * deviation).epsilon(1e-6));
    CHECK(max_in_plane_step(line, path, whole, slow) < 0.05 * stiffness * deviation);
  }
}

TEST_CASE("entering a stroke steps the force by K d as printed, within the rate limit by default", "[render]") {
  const std::vector<Point> path = page_path(line, 0.0);
  const Point along = (path.back() - path.front()).normalized(), left(-along.y(), along.x());
  const auto entering = [&](const RendererOptions& options) {
    HapticRenderer renderer({{line, {{0.02, 0.02}, 0.04}}}, {}, test_device(), options);
    ScriptedPen pen(renderer);
    const Point outside = path.front() + 0.001 * along + 0.0045 * left,
                inside = path.front() + 0.001 * along + 0.003 * left, further = inside + 0.005 * along;
    pen.go({outside.x(), outside.y(), 0.005});
    pen.go({outside.x(), outside.y(), -0.001});
    double before = 0.0, step = 0.0;
    pen.on_tick = [&](const HapticTick& tick) {
      step = std::max(step, std::abs(tick.page_force.head<2>().norm() - before));
      before = tick.page_force.head<2>().norm();
    };
    pen.go({inside.x(), inside.y(), -0.001});
    pen.go({further.x(), further.y(), -0.001});  // where the direction counts too
    CHECK(renderer.last().state == InteractionState::writing);
    if (std::isfinite(options.limits.in_plane_rate)) CHECK(pen.max_unexplained <= 0.1 + 1e-9);
    return step;
  };
  RendererOptions printed = RendererOptions::wang2006(), limited;
  printed.guidance.stiffness = limited.guidance.stiffness = stiffness;
  printed.tolerances.start_distance = limited.tolerances.start_distance = 0.1;  // 4 mm
  printed.contact.box_margin = 0.25;
  const double deviation = std::sqrt(0.004 * 0.004 - 0.001 * 0.001);        // where the pen crosses the start circle
  CHECK(entering(printed) == Approx(stiffness * deviation).epsilon(0.03));  // 1.55 N
  CHECK(entering(limited) < 0.2 * entering(printed));
}

TEST_CASE("as printed, a factor that changes at a feature point steps the force by K d times its change", "[render]") {
  const Character bend = calligraphy_test::typical_character(30, {1.0, 2.0, 2.0, 2.0});  // smooth joints
  // By how much the spring that is felt, force over distance, changes between two ticks in which it acts.
  const auto max_change = [&](Rules rules) {
    RendererOptions options = direct();
    options.rules = rules;
    HapticRenderer renderer({{bend, {{0.02, 0.02}, 0.04}}}, {}, test_device(), options);
    ScriptedPen pen(renderer);
    double last = 0.0, largest = 0.0;
    pen.on_tick = [&](const HapticTick& tick) {
      if (tick.state != InteractionState::writing || tick.contact.weight == 0.0) return;
      const double spring = tick.page_force.head<2>().norm() / tick.contact.closest.distance / tick.contact.weight;
      if (last > 0.0) largest = std::max(largest, std::abs(spring - last));
      last = spring;
    };
    const std::vector<Point> path = page_path(bend, 0.001);
    pen.speed = 0.02;
    pen.go({path.front().x(), path.front().y(), 0.005});
    for (const Point& point : path) pen.go({point.x(), point.y(), -0.001});
    return largest;
  };
  CHECK(max_change(Rules::wang2006) == Approx(stiffness).epsilon(1e-6));  // from 1 to 2
  CHECK(max_change(Rules::revised) < 0.1 * stiffness);
}

TEST_CASE("as printed, crossing the edge of the box while pressing steps the normal force by K d", "[render]") {
  const auto crossing = [](const RendererOptions& options) {
    HapticRenderer renderer({placed(U'三')}, {}, test_device(), options);
    ScriptedPen pen(renderer);
    const Eigen::AlignedBox2d box = bounding_box(renderer.page()[0]);
    pen.go({box.min().x() - 0.012, 0.03, 0.005});
    pen.go({box.min().x() - 0.012, 0.03, -0.003});
    for (int i = 0; i < 100; ++i) pen.at({box.min().x() - 0.012, 0.03, -0.003});
    pen.max_step = 0.0;
    pen.go({box.min().x() + 0.002, 0.03, -0.003});
    return pen.max_step;
  };
  RendererOptions printed = RendererOptions::wang2006(), limited;
  printed.paper.stiffness = limited.paper.stiffness = stiffness;
  CHECK(crossing(printed) == Approx(stiffness * 0.003).epsilon(1e-9));  // 1.2 N
  CHECK(crossing(limited) <= std::hypot(0.4, 0.02));  // 400 N/s at 1 kHz, and the slight damping along the paper
}

TEST_CASE("the signs as printed push away from the stroke and into the paper", "[render]") {
  RendererOptions printed = direct();
  printed.rules = Rules::wang2006;
  printed.paper.stiffness = 0.0;
  printed.guidance.force = {[](const GuidanceInput& in) -> GuidanceTerms {
                              return {stiffness * (in.tip - in.nearest), {0.0, 0.0}, -stiffness * in.depth};
                            },
                            {.stiffness = stiffness}};
  HapticRenderer renderer({{line, {{0.02, 0.02}, 0.04}}}, {}, test_device(), printed);
  ScriptedPen pen(renderer);
  const std::vector<Point> path = page_path(line, 0.002);
  pen.go({path.front().x(), path.front().y(), 0.005});
  for (std::size_t i = 0; i < 100; ++i) pen.go({path[i].x(), path[i].y(), -0.001});
  const HapticTick& tick = renderer.last();
  CHECK(tick.state == InteractionState::writing);
  CHECK(tick.attraction.dot(tick.contact.closest.point - tick.pen_tip.head<2>()) < 0.0);
  CHECK(tick.page_force.z() == Approx(-stiffness * 0.001));
}

TEST_CASE("eq. (5) moves the pen tip into the paper, Table 2 keeps it on the surface", "[render]") {
  for (const Rules rules : {Rules::wang2006, Rules::revised}) {
    RendererOptions options;
    options.rules = rules;
    HapticRenderer renderer({placed(U'三')}, {}, test_device(), options);
    ScriptedPen pen(renderer);
    pen.go({0.03, 0.03, -0.004});
    CHECK(renderer.last().pen_tip.z() == (rules == Rules::revised ? 0.0 : -0.004));
    CHECK(renderer.last().pen_tip.head<2>() == renderer.last().device_point.head<2>());
    CHECK(renderer.last().penetration == Approx(0.004));
  }
}

TEST_CASE("with every rule as printed the same pen feels steps that its motion does not explain", "[render]") {
  HapticRenderer usual({placed(U'永')}, {}, test_device());
  HapticRenderer printed({placed(U'永')}, {}, test_device(), RendererOptions::wang2006());
  ScriptedPen pen(usual), other(printed);
  pen.write(usual.page()[0], 0.002);
  other.write(printed.page()[0], 0.002);
  CHECK(usual.last().character == 1);
  CHECK(pen.max_unexplained <= 1e-12);
  CHECK(other.max_step > 2.0 * pen.max_step);
  CHECK(other.max_unexplained > 1.0);
  CHECK(std::isinf(printed.max_force_step()));
}

TEST_CASE("wang2006() selects every printed rule except the signs", "[render]") {
  const RendererOptions options = RendererOptions::wang2006();
  CHECK(options.nearest.method == NearestPointMethod::wang2006);
  CHECK(options.rules == Rules::wang2006);
  CHECK(std::isinf(options.limits.in_plane_rate));
  CHECK(std::isinf(options.limits.normal_rate));
  CHECK(options.contact.lift_time == 0.0);
  CHECK(options.paper.onset == 0.0);
  CHECK(options.paper.damping == 0.0);
  CHECK(options.guidance.damping == 0.0);
  CHECK(options.stiffness_check == StiffnessCheck::off);
  CHECK(options.guidance.force.is(printed_guidance));
  CHECK_NOTHROW(validate(options, test_device()));
}
