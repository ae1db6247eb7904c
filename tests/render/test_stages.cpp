// The optional stages of the renderer: guidance for large deviations, friction, heat, and all of them
// together.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <calligraphy/render/force_terms.hpp>

#include "../hard_cases.hpp"
#include "../sanitized.hpp"
#include "../scripted_pen.hpp"
#include "render/force_limiter.hpp"

using namespace calligraphy;
using calligraphy_test::beside;
using calligraphy_test::path_of;
using calligraphy_test::placed;
using calligraphy_test::ScriptedPen;
using calligraphy_test::Sequence;
using Eigen::Vector3d;

namespace {

Capabilities warm_device() {
  Capabilities device = calligraphy_test::test_device();
  device.continuous_force = 0.88;
  device.apparent_mass = 0.045;
  return device;
}

RendererOptions everything() { return RendererOptions::everything(warm_device()); }

RendererOptions saturating() {
  RendererOptions options;
  options.guidance.force = saturating_guidance;
  options.guidance.limit = 1.2;
  options.contact.box_margin = 1.5;
  return options;
}

/// These pens set out and turn as no hand does.
HapticRenderer renderer_of(char32_t code, RendererOptions options) {
  options.limits.max_acceleration = std::numeric_limits<double>::infinity();
  return {{placed(code, {0.07, 0.07})}, {}, warm_device(), options};
}

using calligraphy_test::at;

/// The first, straight stroke of 三.
struct FirstStroke {
  Point start, end, along, left;

  explicit FirstStroke(const HapticRenderer& renderer) {
    const Stroke stroke = strokes(renderer.page()[0].character)[0];
    start = renderer.page()[0].placement.to_page(stroke.control_points[0]);
    end = renderer.page()[0].placement.to_page(stroke.control_points[1]);
    along = (end - start).normalized();
    left = {-along.y(), along.x()};
  }
};

void rest(ScriptedPen& pen, const Vector3d& place, int ticks) {
  for (int i = 0; i < ticks; ++i) pen.at(place);
}

/// Starts the first stroke and moves 10 mm along it, pressed in by 2 mm.
FirstStroke begin_writing(ScriptedPen& pen, const HapticRenderer& renderer) {
  const FirstStroke stroke(renderer);
  pen.go(at(stroke.start, 0.005));
  pen.go(at(stroke.start, -0.002));
  pen.go(at(stroke.start + 0.01 * stroke.along, -0.002));
  return stroke;
}

/// Changes of state, and what happened meanwhile.
struct Watch {
  std::string states, events;

  void operator()(const HapticTick& tick) {
    const std::string state = to_string(tick.state);
    if (states.empty() || states.substr(states.size() - 2) != state) states += states.empty() ? state : " " + state;
    const std::pair<TickEvent, char> names[] = {{TickEvent::stroke_started, 's'},
                                                {TickEvent::feature_passed, 'p'},
                                                {TickEvent::stroke_finished, 'f'},
                                                {TickEvent::stroke_abandoned, 'a'}};
    for (const auto& [event, letter] : names) {
      if (has_event(tick.events, event)) events += letter;
    }
  }
};

void check_steps(const ScriptedPen& pen, const HapticRenderer& renderer) {
  CHECK(pen.finite);
  // The energy budget may take a force away at once.
  if (std::isinf(renderer.options().energy.budget)) CHECK(pen.max_unexplained <= 1e-12);
  CHECK(pen.max_force <= 3.3 * (1.0 + 1e-12));
}

constexpr int random_strokes = calligraphy_test::sanitized ? 2 : 10;

/// Writing, jumps and random motion in and above the paper, at speeds up to 1 m/s.
void wander(ScriptedPen& pen, const HapticRenderer& renderer, std::uint64_t seed) {
  Sequence random(seed);
  const auto all = strokes(renderer.page()[0].character);
  for (int i = 0; i < random_strokes; ++i) {
    pen.speed = random.between(0.05, 1.0);
    const auto& stroke = all[static_cast<std::size_t>(random.next() * static_cast<double>(all.size()))];
    pen.write(beside(path_of(stroke, renderer.page()[0].placement, 1e-3), random.between(-0.012, 0.012)),
              random.between(0.0, 0.006));
    for (int k = 0; k < 5; ++k) pen.go(at(random.point(0.03, 0.15), random.between(-0.006, 0.004)));
  }
}

}  // namespace

TEST_CASE("saturating guidance has the stiffness of eq. (8) near the stroke and stays below its limit at any distance",
          "[render]") {
  HapticRenderer renderer = renderer_of(U'三', saturating());
  ScriptedPen pen(renderer);
  const FirstStroke stroke = begin_writing(pen, renderer);
  const double stiffness = renderer.options().guidance.stiffness;
  double last = 0.0;
  for (const double distance : {0.00005, 0.0001, 0.001, 0.002, 0.005, 0.011, 0.013, 0.02, 0.03, 0.05}) {
    pen.go(at(stroke.start + 0.01 * stroke.along + distance * stroke.left, -0.002));
    const HapticTick& tick = renderer.last();
    REQUIRE(tick.state == InteractionState::writing);
    const double pull = -tick.attraction.dot(stroke.left);
    INFO(distance << " m: " << pull << " N");
    CHECK(pull == Approx(tick.attraction.norm()));  // straight back
    CHECK(pull > last);
    CHECK(pull < 1.2);
    if (distance < 0.0002) CHECK(pull == Approx(stiffness * distance).epsilon(0.01));
    if (distance > 0.01) CHECK(pull > 0.95 * 1.2);
    last = pull;
  }
}

TEST_CASE("the linear law ends where the saturating one still guides", "[render]") {
  for (const bool saturates : {false, true}) {
    RendererOptions options = saturating();
    if (!saturates) options.guidance.force = linear_guidance;
    HapticRenderer renderer = renderer_of(U'三', options);
    ScriptedPen pen(renderer);
    const FirstStroke stroke = begin_writing(pen, renderer);
    pen.go(at(stroke.start + 0.01 * stroke.along - 0.015 * stroke.left, -0.002));
    CHECK(renderer.last().state == InteractionState::writing);
    CHECK((renderer.last().attraction.norm() > 1.1) == saturates);
    CHECK((renderer.last().attraction.norm() == 0.0) == !saturates);
  }
}

TEST_CASE("a misplaced pen is pulled to the stroke's start, but only on the paper and before the stroke", "[render]") {
  for (const bool leads : {false, true}) {
    RendererOptions options = saturating();
    options.guidance.to_start = leads;
    HapticRenderer renderer = renderer_of(U'三', options);
    const FirstStroke stroke(renderer);
    const Point astray = stroke.start + 0.03 * stroke.along + 0.02 * stroke.left;
    ScriptedPen pen(renderer);
    pen.go(at(astray, 0.005));
    rest(pen, at(astray, 0.005), 50);
    CHECK(renderer.last().force == Vector3d(0, 0, 0));  // in the air
    pen.go(at(astray, -0.001));
    CHECK(renderer.last().page_force.head<2>().norm() < 0.1);  // 10 ms on the paper: it has begun to fade in
    rest(pen, at(astray, -0.001), 500);
    CHECK(renderer.last().state == InteractionState::calibration);
    const Point in_plane = renderer.last().page_force.head<2>();
    if (leads) {
      // Along the stroke not to the very start, which the pen is about to leave: to within half of the 8 mm permitted.
      CHECK(in_plane.normalized().isApprox((stroke.start + 0.004 * stroke.along - astray).normalized()));
      CHECK(in_plane.norm() > 1.0);
      CHECK(in_plane.norm() <= 1.2);
    } else {
      CHECK(in_plane == Point(0, 0));
    }
    pen.go(at(astray, 0.005));
    rest(pen, at(astray, 0.005), 400);
    CHECK(renderer.last().force.norm() < 1e-6);  // withdrawn in the air within guidance_fade_out
    pen.go(at(astray, -0.001));
    CHECK(renderer.last().page_force.head<2>().norm() < 0.1);  // and fades in again with each contact
    pen.go(at(stroke.start, -0.001));
    pen.go(at(stroke.start + 0.005 * stroke.along, -0.001));
    CHECK(renderer.last().state == InteractionState::writing);
    pen.go(at(stroke.end, -0.001));
    rest(pen, at(stroke.end, -0.001), 25);  // it is looked at
    CHECK(renderer.last().stroke == 1);
    pen.go(at(astray, -0.001));  // not lifted yet: the next stroke may not begin
    rest(pen, at(astray, -0.001), 100);
    CHECK(renderer.last().attraction == Point(0, 0));
    pen.go({-0.05, -0.05, -0.001});  // outside the box
    CHECK(renderer.last().state == InteractionState::adjusting);
    CHECK(renderer.last().attraction == Point(0, 0));
    check_steps(pen, renderer);
  }
}

TEST_CASE("a pen returns from anywhere without a force step, whatever the stages", "[render]") {
  for (const RendererOptions& options : {RendererOptions{}, saturating(), everything()}) {
    HapticRenderer renderer = renderer_of(U'三', options);
    ScriptedPen pen(renderer);
    const FirstStroke stroke(renderer);
    Sequence random(77);
    double largest = 0.0;
    for (int i = 0; i < 20; ++i) {
      pen.speed = random.between(0.05, 0.5);
      begin_writing(pen, renderer);
      // Out of the tube, out of the box, into the air, and back on another path.
      pen.go(at(stroke.start + random.point(-0.1, 0.1), i % 3 == 0 ? 0.004 : -random.between(0.0, 0.005)));
      pen.go(at(stroke.start + random.point(-0.03, 0.05), -random.between(0.0, 0.005)));
      rest(pen, at(stroke.start + 0.015 * stroke.along + random.point(-0.01, 0.01), -0.004), 50);
      largest = std::max(largest, renderer.last().force.norm());
    }
    CHECK(largest > 1.0);
    check_steps(pen, renderer);
  }
}

TEST_CASE("friction opposes the writing motion with mu N, and there is none in the air", "[render]") {
  RendererOptions options;
  options.paper.friction.coefficient = 0.2;
  HapticRenderer renderer = renderer_of(U'三', options);
  ScriptedPen pen(renderer);
  const FirstStroke stroke = begin_writing(pen, renderer);
  double in_air = 0.0;
  int writing = 0;
  pen.on_tick = [&](const HapticTick& tick) {
    if (tick.state == InteractionState::separation) in_air = std::max(in_air, tick.friction.norm());
    if (tick.state != InteractionState::writing || tick.penetration < 0.0019) return;
    // Computed from the force of the last tick, which the normal force of this one follows.
    CHECK((tick.friction + 0.2 * 600.0 * (0.002 - 0.00025) * stroke.along).norm() < 1e-6);
    ++writing;
  };
  pen.go(at(stroke.end - 0.004 * stroke.along, -0.002));
  pen.go(at(stroke.end - 0.004 * stroke.along, 0.01));
  rest(pen, at(stroke.end, 0.01), 400);
  CHECK(writing > 50);
  CHECK(in_air == 0.0);
  CHECK(renderer.last().force == Vector3d(0, 0, 0));
  check_steps(pen, renderer);
}

TEST_CASE("a pen at rest on the paper feels no friction, nor does the next contact at first", "[render]") {
  RendererOptions options;
  options.paper.friction.coefficient = 0.3;
  HapticRenderer renderer = renderer_of(U'三', options);
  ScriptedPen pen(renderer);
  const FirstStroke stroke = begin_writing(pen, renderer);
  CHECK(renderer.last().friction.norm() > 0.1);
  pen.go(at(stroke.start, 0.005));
  const Point elsewhere = stroke.start + 0.02 * stroke.along;
  pen.go(at(elsewhere, 0.005));
  bool none = true;
  pen.on_tick = [&](const HapticTick& tick) { none = none && tick.friction == Point(0, 0); };
  for (int i = 0; i < 500; ++i) pen.at(at(elsewhere, 0.001 - 1e-5 * i));
  CHECK(renderer.last().normal > 1.0);
  CHECK(none);
}

TEST_CASE("a pen pressed for a minute: warm motors reduce the force to the continuous one, in the same direction",
          "[render]") {
  RendererOptions plain;
  plain.limits.thermal_time_constant = 10.0;
  RendererOptions all = everything();
  all.energy.budget = std::numeric_limits<double>::infinity();  // it would not let the force reach the peak
  for (const RendererOptions& options : {plain, all}) {
    HapticRenderer renderer = renderer_of(U'三', options);
    ScriptedPen pen(renderer);
    const FirstStroke stroke = begin_writing(pen, renderer);
    const Vector3d place = at(stroke.start + 0.01 * stroke.along + 0.006 * stroke.left, -0.02);
    pen.go(place);
    rest(pen, place, 500);
    const HapticTick& tick = renderer.last();
    CHECK(pen.max_force == Approx(2.0 * 0.88).epsilon(0.03));
    CHECK(tick.hint != WritingHint::warm_motors);  // they are not yet
    double last = tick.force.norm(), max_rise = 0.0, max_fall = 0.0, max_turn = 0.0, hottest = 0.0;
    constexpr int seconds = calligraphy_test::sanitized ? 40 : 60;
    for (int i = 0; i < 1000 * seconds; ++i) {
      pen.at(place);
      const double size = tick.force.norm();
      // The friction left from the approach falls with the normal force, and turns the force slightly.
      Vector3d wanted(0, 0, tick.normal);
      wanted.head<2>() = tick.attraction + tick.wrong_way + tick.friction;
      max_rise = std::max(max_rise, size - last);
      max_fall = std::max(max_fall, 1.0 - size / last);
      max_turn = std::max(max_turn, (tick.force / size - wanted.normalized()).norm());
      hottest = std::max(hottest, tick.heat);
      last = size;
    }
    CHECK(last == Approx(0.88).epsilon(0.03));
    CHECK(last >= 0.88 * (1.0 - 1e-9));
    CHECK(max_rise <= 1e-9);
    CHECK(max_fall <= 2.01 * 0.001 / 10.0);  // by a tenth per second, and two ticks' worth in the last one
    CHECK(tick.hint != WritingHint::none);  // of the default law, which has let go, another one
    CHECK(max_turn < 1e-3);
    CHECK(hottest <= 1.0 + 1e-7);
    pen.go(at(stroke.start, 0.01));
    rest(pen, at(stroke.start, 0.01), 30'000);
    CHECK(tick.heat < 0.06);
    check_steps(pen, renderer);
  }
}

TEST_CASE("with an energy budget the paper still never pulls, however fast the pen is lifted", "[render]") {
  HapticRenderer renderer = renderer_of(U'三', everything());
  REQUIRE(renderer.options().energy.limited());
  ScriptedPen pen(renderer);
  const FirstStroke stroke(renderer);
  double least = 0.0, most = 0.0;
  pen.on_tick = [&](const HapticTick& tick) {
    least = std::min(least, tick.page_force.z());
    most = std::max(most, tick.page_force.z());
  };
  Sequence random(5);
  for (int i = 0; i < 200; ++i) {
    pen.speed = random.between(0.05, 1.5);
    pen.go(at(stroke.start + random.point(-0.01, 0.03), -random.between(0.0, 0.01)));
    pen.go(at(stroke.start + random.point(-0.01, 0.03), random.between(0.0, 0.01)));
  }
  CHECK(least == 0.0);
  CHECK(most > 1.0);
  check_steps(pen, renderer);
}

TEST_CASE("a disabled stage changes no bit, whatever its parameters", "[render]") {
  RendererOptions changed;
  changed.guidance.limit = 0.01;
  changed.guidance.assist.retention = 0.1;
  changed.guidance.assist.full_assistance_error = 1e-5;
  changed.guidance.assist.min_assistance = 0.9;
  changed.paper.friction.stiffness = 10.0;
  changed.paper.friction.damping = 1.0;
  changed.energy.max_gap = 0.1;
  for (const char32_t code : {U'三', U'永'}) {
    HapticRenderer one = renderer_of(code, RendererOptions{}), other = renderer_of(code, changed);
    ScriptedPen pen(one);
    int different = 0, with_force = 0;
    pen.on_tick = [&](const HapticTick& tick) {
      DeviceState state;
      state.position = one.mapping().to_device(tick.device_point);
      state.time = tick.time;
      const HapticTick& twin = other.update(state);
      different += !(twin.force == tick.force) || twin.state != tick.state;
      with_force += tick.force.norm() > 0.5;
    };
    wander(pen, one, 6);
    CHECK(different == 0);
    CHECK(with_force > 100);
  }
}

TEST_CASE("with every stage disabled the force is the plain composition: terms, sum, limits", "[render]") {
  RendererOptions options;
  options.guidance.fade_in = options.guidance.fade_out = 0.0;
  HapticRenderer renderer = renderer_of(U'永', options);
  ScriptedPen pen(renderer);
  const ForceLimiter limiter{0.1, 0.4, 3.3};
  VelocityEstimator velocity;
  Vector3d force(0, 0, 0), last(0, 0, 0);
  bool first = true;
  double max_difference = 0.0, max_force = 0.0;
  pen.on_tick = [&](const HapticTick& tick) {
    Vector3d sum(0, 0, 0);
    if (tick.state == InteractionState::writing) {
      const StrokeContact& contact = tick.contact;
      const bool is_held = tick.attraction != Point(0, 0);  // when it is, test_hints.cpp says
      const double share = is_held ? contact.weight : 0.0;
      Point target = contact.closest.point;
      const Point &tip = tick.pen_tip.head<2>(), &tangent = contact.closest.tangent;
      if (contact.finished) target += std::max(0.0, (tip - target).dot(tangent)) * tangent;
      sum.head<2>() = attraction_force(600.0 * share * contact.attraction, tip, target) +
                      share * wrong_way_force(200.0, 1.0, 0.002, contact.backwards, tangent);
    } else if (tick.state == InteractionState::calibration) {
      sum.head<2>() = tick.attraction + tick.wrong_way;
    }
    const bool solid = tick.state == InteractionState::writing || tick.state == InteractionState::calibration;
    const double into = std::max(0.0, -tick.device_point.z()), onset = 0.0005;
    if (solid) sum.z() = normal_force(600.0, into < onset ? into * into / (2.0 * onset) : into - 0.5 * onset);
    sum += tick.viscous;
    // K |dx| + B |dv|, and the damper of the paper where the pen enters.
    const Vector3d way = first ? Vector3d(0, 0, 0) : Vector3d(tick.device_point - last), before = velocity.velocity();
    const Vector3d kick = velocity.update(tick.device_point, 0.001) - before;
    const double down = std::abs(way.z()), speed = std::abs(velocity.velocity().z());
    const double shoved = std::abs(kick.z()) + std::min(1.0, down / onset) * speed;
    const ForceAllowance allowance{
        800.0 * std::min(way.head<2>().norm(), 0.001) + 4.0 * std::min(kick.head<2>().norm(), 0.3),
        600.0 * std::min(down, 0.001) + 4.0 * std::min(shoved, 0.3)};
    force = limiter.next(force, sum, allowance);
    max_difference = std::max(max_difference, (force - tick.force).norm());
    max_force = std::max(max_force, force.norm());
    last = tick.device_point;
    first = false;
    CHECK(tick.friction == Point(0, 0));
    CHECK(tick.assistance == 1.0);
    CHECK(tick.heat == 0.0);
    CHECK(tick.energy_given == 0.0);
  };
  rest(pen, {0.1, 0.1, 0.01}, 20);  // at first the force follows by its rate alone
  pen.go({0.1, 0.1, 0.01});
  wander(pen, renderer, 8);
  CHECK(max_difference < 1e-12);
  CHECK(max_force > 1.0);
}

TEST_CASE("with every stage enabled strokes are written exactly, beside and shifted", "[render]") {
  struct Deviation {
    char32_t character;
    double beside;  ///< [m]
    Point shift;    ///< [m]
  };
  // Beside a stroke that turns by any angle, the pen deviates from a shift by up to twice the offset: 2 mm, within the
  // corridor.
  std::vector<Deviation> deviations = {{U'永', 0.0, {0, 0}},
                                       {U'永', 0.001, {0, 0}},
                                       {U'永', -0.001, {0, 0}},
                                       {U'三', 0.003, {0, 0}},
                                       {U'三', -0.003, {0, 0}}};
  for (int eighth = 0; eighth < 8; ++eighth) {
    const double angle = eighth * std::acos(-1.0) / 4.0;
    deviations.push_back({U'永', 0.0, 0.002 * Point(std::cos(angle), std::sin(angle))});  // 5 % of the em
  }
  for (const auto& [character, offset, shift] : deviations) {
    HapticRenderer renderer = renderer_of(character, everything());
    ScriptedPen pen(renderer);
    Watch watch;
    pen.on_tick = [&](const HapticTick& tick) { watch(tick); };
    PlacedCharacter where = renderer.page()[0];
    where.placement.origin += shift;
    pen.write(where, offset);
    INFO(offset << " m, " << shift.transpose() << " m: " << watch.events);
    CHECK(renderer.last().character == 1);
    CHECK(watch.events.find('a') == std::string::npos);
    check_steps(pen, renderer);
  }
}

TEST_CASE("a pen on the feature plane or chattering across it passes one feature point and keeps its state",
          "[render]") {
  for (const RendererOptions& options : {RendererOptions{}, everything()}) {
    const PlacedCharacter corner{calligraphy_test::typical_character(16), {{0.07, 0.07}, 0.04}};
    const Stroke stroke = strokes(corner.character)[0];
    const Point start = corner.placement.to_page(stroke.control_points[0]);
    const Point turn = corner.placement.to_page(stroke.control_points[1]);
    const Point along = (turn - start).normalized();
    for (const double before : {0.0, 0.0015}) {
      HapticRenderer renderer({corner}, {}, warm_device(), options);
      ScriptedPen pen(renderer);
      pen.go(at(start, 0.005));
      pen.go(at(start, -0.001));
      pen.go(at(start + 0.003 * along, -0.001));
      Watch watch;
      pen.on_tick = [&](const HapticTick& tick) { watch(tick); };
      const Point plane = turn - before * along;
      pen.go(at(plane, -0.001));
      rest(pen, at(plane, -0.001), 500);
      for (const int half : {1, 2, 7, 50}) {
        for (int i = 0; i < 400; ++i) pen.at(at(plane + (i / half % 2 ? 1e-4 : -1e-4) * along, -0.001));
      }
      CHECK(watch.states == "WS");
      CHECK(watch.events == "p");
      check_steps(pen, renderer);
    }
  }
}

TEST_CASE("a finished stroke stays finished, and a pen back on it changes no state", "[render]") {
  for (const RendererOptions& options : {RendererOptions{}, everything()}) {
    HapticRenderer renderer = renderer_of(U'三', options);
    ScriptedPen pen(renderer);
    const auto first = path_of(strokes(renderer.page()[0].character)[0], renderer.page()[0].placement, 1e-4);
    pen.write(first);
    CHECK(renderer.last().stroke == 1);
    Watch watch;
    pen.on_tick = [&](const HapticTick& tick) { watch(tick); };
    pen.write(first);
    CHECK(watch.states == "SS CS SS");
    CHECK(watch.events.empty());
    CHECK(renderer.last().stroke == 1);
    check_steps(pen, renderer);
  }
}

TEST_CASE(
    "a pen lifted after one sample begins no stroke, after the first stretch it abandons it, without a force step",
    "[render]") {
  for (const RendererOptions& options : {RendererOptions{}, everything()}) {
    HapticRenderer renderer = renderer_of(U'三', options);
    ScriptedPen pen(renderer);
    const FirstStroke stroke(renderer);
    Watch watch;
    pen.on_tick = [&](const HapticTick& tick) { watch(tick); };
    rest(pen, at(stroke.start, 0.0035), 1);
    std::string states = "SS", events;
    for (int i = 0; i < 20; ++i) {
      pen.at(at(stroke.start, -0.001));
      if (i % 2 == 1) pen.at(at(stroke.start + 0.002 * stroke.along, -0.001));
      rest(pen, at(stroke.start, 0.0035), 5 * (i % 4) + 1);  // too high for a bounce; decided then, or at the touch
      states += i % 2 == 1 ? " CS WS SS" : " CS SS";
      events += i % 2 == 1 ? "sa" : "";
    }
    rest(pen, at(stroke.start, 0.0035), 25);
    CHECK(watch.states == states);
    CHECK(watch.events == events);
    CHECK(renderer.last().stroke == 0);
    check_steps(pen, renderer);
    watch = {};
    pen.write(renderer.page()[0]);
    CHECK(renderer.last().character == 1);
  }
}

TEST_CASE("a stroke that crosses a finished one is written as if it were alone", "[render]") {
  for (const RendererOptions& options : {RendererOptions{}, everything()}) {
    HapticRenderer renderer = renderer_of(U'木', options);
    ScriptedPen pen(renderer);
    for (const Stroke& stroke : strokes(renderer.page()[0].character)) {
      Watch watch;
      pen.on_tick = [&](const HapticTick& tick) { watch(tick); };
      const int before = renderer.last().stroke;
      pen.write(path_of(stroke, renderer.page()[0].placement, 1e-4));
      INFO("stroke " << before + 1 << ": " << watch.states << ", " << watch.events);
      CHECK(watch.states == "SS CS WS CS SS");
      CHECK(watch.events.front() == 's');
      CHECK(watch.events.back() == 'f');
      CHECK(std::count(watch.events.begin(), watch.events.end(), 's') == 1);
    }
    CHECK(renderer.last().character == 1);
    check_steps(pen, renderer);
  }
}

namespace {

/// Moves the pen in the paper of a device that says which force was at work, `share` of the one sent, and compares the
/// energy given with the work of that force, all in device axes. Relative to the maximum work.
double error_of_energy(double share, bool says_so, int pause) {
  RendererOptions options = everything();
  options.energy.budget = 10.0;
  MotionMapping mapping = desk_page(0.2, 0.2);
  mapping.scale = 2.0;
  options.stiffness_check = StiffnessCheck::clip;
  options.limits.max_acceleration = std::numeric_limits<double>::infinity();
  HapticRenderer renderer({placed(U'永', {0.07, 0.07})}, mapping, warm_device(), options);
  double given = 0.0, most = 0.0, error = 0.0, time = 0.0;
  Vector3d place(0, 0, 0), at_work(0, 0, 0);
  Sequence random(12);
  for (int i = 0; i < 2000; ++i) {
    const Point tip = Point(0.09, 0.09) + 0.01 * Point(std::cos(0.03 * i), std::sin(0.03 * i));
    DeviceState state;
    state.position = mapping.to_device(at(tip, -random.between(0.001, 0.002)));
    // At times the loop pauses for up to `pause` ticks, in which the force is held and the pen goes on.
    time += 0.001 * (1.0 + std::floor(pause * random.next()));
    state.time = time;
    if (says_so) state.force = at_work;
    if (i > 0) given += at_work.dot(state.position - place);
    place = state.position;
    const HapticTick& tick = renderer.update(state);
    error = std::max(error, std::abs(tick.energy_given - given));
    most = std::max(most, std::abs(given));
    at_work = share * tick.force;
  }
  CHECK(most > 1e-4);
  return error / most;
}

}  // namespace

TEST_CASE("the energy account sees the force at work, as the device reports it, and pauses of the loop", "[render]") {
  CHECK(error_of_energy(1.0, false, 0) < 1e-9);
  CHECK(error_of_energy(1.0, true, 0) < 1e-9);
  CHECK(error_of_energy(0.3, true, 0) < 1e-9);
  CHECK(error_of_energy(0.3, false, 0) > 0.1);  // a device that does not say
  CHECK(error_of_energy(1.0, true, 12) < 1e-9);
}

TEST_CASE("behind a guard that halves the force, and pauses, no more than the budget reaches the hand", "[render]") {
  // 20 mm to and fro across the stroke at up to 1 m/s: the guidance, held over pauses, would drive the pen.
  RendererOptions options = everything();
  HapticRenderer renderer = renderer_of(U'三', options);
  const FirstStroke stroke(renderer);
  Sequence random(4);
  double given = 0.0, most = 0.0, strongest = 0.0;
  Vector3d place(0, 0, 0), at_work(0, 0, 0);
  double time = 0.0;
  for (int i = 0; i < 20'000; ++i) {
    time += random.next() < 0.2 ? 0.001 * (1.0 + std::floor(16.0 * random.next())) : 0.001;
    const double across = i < 50 ? 0.0 : 0.02 * std::sin(50.0 * time);
    DeviceState state;
    state.time = time;
    state.position = at(stroke.start + std::min(0.01, 1e-4 * i) * stroke.along + across * stroke.left, -0.002);
    state.force = at_work;
    if (i > 0) given += at_work.dot(state.position - place);
    most = std::max(most, given);
    place = state.position;
    const HapticTick& tick = renderer.update(state);
    strongest = std::max(strongest, tick.force.norm());
    at_work = (random.next() < 0.5 ? 0.5 : 1.0) * tick.force;
  }
  CHECK(most <= options.energy.budget * (1.0 + 1e-9));
  CHECK(strongest > 1.0);
}
