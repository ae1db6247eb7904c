// Implausible samples: the force stays finite, bounded and without steps, and the loop recovers.
#include "../catch.hpp"

#include <cmath>

#include <calligraphy/devices/device_profiles.hpp>

#include "../hard_cases.hpp"
#include "../sanitized.hpp"
#include "../scripted_pen.hpp"
#include "../special_values.hpp"

using namespace calligraphy;
using calligraphy_test::path_of;
using calligraphy_test::placed;
using calligraphy_test::ScriptedPen;
using calligraphy_test::Sequence;
using calligraphy_test::test_device;
using Eigen::Vector3d;

namespace {

using calligraphy_test::infinity;
using calligraphy_test::not_a_number;
constexpr double extremes[] = {0.0,   -0.0,   5e-324,  1e-310,   -1.0,     1.0,       1e3,
                               1e154, -1e200, 1.7e308, -1.7e308, infinity, -infinity, not_a_number};

/// A renderer in the middle of a stroke, with the pen 3 mm off the stroke and 2 mm in the paper.
struct MidStroke {
  HapticRenderer renderer;
  ScriptedPen pen;
  Vector3d place;

  explicit MidStroke(const RendererOptions& options = {}, const Capabilities& device = test_device())
      : renderer({placed(U'三')}, {}, device, options), pen(renderer, renderer.options().servo_rate) {
    const Stroke first = strokes(renderer.page()[0].character)[0];
    const Point start = renderer.page()[0].placement.to_page(first.control_points[0]);
    place = {start.x() + 0.01, start.y() + 0.003, -0.002};
    pen.go({start.x(), start.y(), 0.005});
    pen.go({start.x(), start.y(), -0.002});
    pen.go(place);
    rest(static_cast<int>(0.3 * renderer.options().servo_rate));
  }
  void rest(int ticks) {
    for (int i = 0; i < ticks; ++i) pen.at(place);
  }
};

DeviceState state_with(const Vector3d& position, DeviceStatus status = DeviceStatus::ok) {
  DeviceState state;
  state.position = position;
  state.status = status;
  return state;
}

double any_of(Sequence& random) { return extremes[static_cast<std::size_t>(random.next() * std::size(extremes))]; }

/// Ticks of every kind: pen-like motion, jumps, extremes, frozen samples, faults, clocks that stop or run backwards.
void torment(HapticRenderer& renderer, std::uint64_t seed, int ticks, double& max_excess, int& not_finite) {
  Sequence random(seed);
  Vector3d position(0.03, 0.05, 0.0), last = renderer.last().force;
  double time = 0.0;
  const double step = renderer.max_force_step();
  for (int i = 0; i < ticks; ++i) {
    DeviceState state;
    const double kind = random.next();
    if (kind < 0.6)
      position += Vector3d{random.between(-1e-3, 1e-3), random.between(-1e-3, 1e-3), random.between(-1e-3, 1e-3)};
    else if (kind < 0.75)
      position = Vector3d{random.between(0, 0.08), random.between(0, 0.08), random.between(-0.02, 0.005)};
    else if (kind < 0.8)
      position = -position;
    state.position = position;
    if (kind > 0.97) state.position[static_cast<Eigen::Index>(3.0 * random.next())] = any_of(random);
    if (!position.allFinite() || position.norm() > 0.2) position = Vector3d(0.03, 0.05, 0.0);
    if (kind > 0.9) state.velocity = Vector3d{any_of(random), any_of(random), any_of(random)};
    time += kind < 0.9 ? 0.001 : random.between(-1.0, 10.0);
    state.time = kind > 0.995 ? any_of(random) : time;
    state.status = kind > 0.985 && kind < 0.99 ? static_cast<DeviceStatus>(i % 9) : DeviceStatus::ok;
    const HapticTick& tick = renderer.update(state);
    not_finite += !tick.force.allFinite() || !tick.page_force.allFinite() || !tick.pen_tip.allFinite() ||
                  !tick.contact.closest.point.allFinite();
    max_excess = std::max({max_excess, (tick.force - last).norm() - step, tick.force.norm() - 3.3});
    last = tick.force;
  }
}

constexpr int torment_ticks = calligraphy_test::sanitized ? 20'000 : 200'000;

}  // namespace

TEST_CASE("on bad samples the force ramps down to zero, and it recovers with the next good ones", "[render]") {
  for (const double value : {infinity, -infinity, not_a_number, 1e200, 1.0}) {
    for (int axis = 0; axis < 3; ++axis) {
      MidStroke test;
      const Vector3d before = test.renderer.last().force;
      REQUIRE(before.norm() > 1.5);
      Vector3d position = test.place;
      for (int i = 0; i < 60; ++i) {
        position[axis] = value + (i % 2 ? 0.1 : -0.1);  // never the same twice: not a pen
        CHECK(test.pen.sample(state_with(position)).status == TickStatus::bad_sample);
      }
      CHECK(test.renderer.last().force == Vector3d(0, 0, 0));
      test.rest(60);
      CHECK(test.renderer.last().status == TickStatus::ok);
      CHECK(test.renderer.last().force.isApprox(before));
      CHECK(test.pen.finite);
      CHECK(test.pen.max_unexplained <= 1e-12);
    }
  }
}

TEST_CASE("on a missing or faulty device the force ramps down to zero, and does not step on its return", "[render]") {
  for (const DeviceStatus status : {DeviceStatus::disconnected, DeviceStatus::needs_calibration, DeviceStatus::fault,
                                    static_cast<DeviceStatus>(200)}) {
    MidStroke test;
    for (int i = 0; i < 100; ++i) {
      CHECK(test.pen.sample(state_with(test.place, status)).status == TickStatus::device_fault);
    }
    CHECK(test.renderer.last().force == Vector3d(0, 0, 0));
    test.pen.max_step = 0.0;
    test.rest(100);
    CHECK(test.pen.max_step <= std::hypot(0.1, 0.4) + 1e-9);  // the pen has not moved meanwhile
    CHECK(test.renderer.last().status == TickStatus::ok);
    CHECK(test.renderer.last().force.norm() > 1.0);
    CHECK(test.pen.max_unexplained <= 1e-12);
  }
}

TEST_CASE("a pen that is moved while no good sample arrives feels no step on its return", "[render]") {
  for (const DeviceStatus status : {DeviceStatus::ok, DeviceStatus::stale, DeviceStatus::fault}) {
    for (const int missed : {1, 3, 10, 100}) {
      for (const bool moves_on : {false, true}) {
        MidStroke test;
        const Vector3d unknown(not_a_number, 0.0, 0.0);  // with status ok: a bad sample
        for (int i = 0; i < missed; ++i) test.pen.sample(state_with(unknown, status));
        // Deeper into the paper, almost as far as a hand can be, faster than the force may follow.
        const double time = 0.001 * (missed + 1), way = std::min(0.01, std::max(0.15 * time, 40.0 * time * time));
        test.place += Vector3d(0.0, std::min(way, 0.004), -way);
        const Vector3d before = test.renderer.last().force;
        CAPTURE(static_cast<int>(status), missed, moves_on);
        for (int i = 0; i < 200; ++i) {
          const Vector3d last = test.renderer.last().force;
          test.pen.at(test.place);
          if (moves_on) test.place.x() += 1e-5;
          REQUIRE(test.renderer.last().status == TickStatus::ok);
          const bool was_gap = status != DeviceStatus::stale || missed > 4;
          if (i >= (was_gap ? 10 : 1)) continue;  // its velocity is that of a way that nobody saw
          const Vector3d step = test.renderer.last().force - last;
          CHECK(step.head<2>().norm() <= 0.1 + 1e-12);
          CHECK(std::abs(step.z()) <= 0.4 + 1e-12);
        }
        CHECK(test.renderer.last().state == InteractionState::writing);
        CHECK(test.renderer.last().force.norm() > before.norm());
        CHECK(test.pen.max_unexplained <= 1e-12);
      }
    }
  }
}

TEST_CASE("warm motors are no fault", "[render]") {
  MidStroke test;
  const Vector3d before = test.renderer.last().force;
  for (int i = 0; i < 1000; ++i) test.pen.sample(state_with(test.place, DeviceStatus::warm_motors));
  CHECK(test.renderer.last().status == TickStatus::ok);
  CHECK(test.renderer.last().force == before);
}

TEST_CASE("while samples are stale the force is held for 4 ms, then ramps down, and returns with a fresh one",
          "[render]") {
  for (const double rate : {1000.0, 4000.0}) {
    RendererOptions options;
    options.servo_rate = rate;
    MidStroke test(options);
    const Vector3d before = test.renderer.last().force;
    REQUIRE(before.norm() > 1.0);
    const int held = static_cast<int>(std::lround(0.004 * rate));
    int released = 0;
    for (int i = 1; i <= 400; ++i) {
      const HapticTick& tick = test.pen.sample(state_with(test.place, DeviceStatus::stale));
      CHECK(tick.status == TickStatus::stale);
      CHECK(tick.events == TickEvent::none);
      if (i <= held) CHECK(tick.force == before);
      if (i > held && tick.force != Vector3d(0, 0, 0)) ++released;
      if (i > held) CHECK(tick.attraction == Point(0, 0));
    }
    // 100 and 400 N/s, in the direction of the force.
    CHECK(released == static_cast<int>(std::ceil(before.norm() / std::hypot(100.0, 400.0) * rate)) - 1);
    CHECK(test.renderer.last().force == Vector3d(0, 0, 0));
    test.rest(static_cast<int>(0.3 * rate));
    CHECK(test.renderer.last().status == TickStatus::ok);
    CHECK(test.renderer.last().state == InteractionState::writing);
    CHECK(test.renderer.last().force.isApprox(before));
    CHECK(test.pen.max_unexplained <= 1e-12);
  }
}

TEST_CASE("while the force is held so are its terms, and a device that cannot be trusted has none", "[render]") {
  RendererOptions options;
  options.paper.friction.coefficient = 0.2;
  options.paper.friction.stiffness = 200.0;
  MidStroke test(options);
  test.pen.at(test.place + Vector3d(0.0001, 0, 0));
  test.pen.at(test.place + Vector3d(0.0002, 0, 0));  // drags the friction spring, and is damped
  const HapticTick before = test.renderer.last();
  REQUIRE(before.attraction.norm() > 0.1);
  REQUIRE(before.friction.norm() > 0.01);
  REQUIRE(before.normal > 0.1);
  REQUIRE(before.viscous.norm() > 0.01);
  const auto is_as_before = [&](const HapticTick& tick) {
    return tick.attraction == before.attraction && tick.friction == before.friction && tick.normal == before.normal &&
           tick.viscous == before.viscous;
  };
  for (int i = 0; i < 4; ++i) {
    CHECK(is_as_before(test.pen.sample(state_with(test.place, DeviceStatus::stale))));
  }
  for (const DeviceStatus status : {DeviceStatus::stale, DeviceStatus::fault}) {
    const HapticTick& tick = test.pen.sample(state_with(test.place, status));
    CHECK(tick.attraction == Point(0, 0));
    CHECK(tick.friction == Point(0, 0));
    CHECK(tick.normal == 0.0);
    CHECK(tick.viscous == Vector3d(0, 0, 0));
  }
}

TEST_CASE("a stale sample is not taken for a fresh one: it moves nothing, whatever it says", "[render]") {
  MidStroke test;
  const HapticTick before = test.renderer.last();
  for (int i = 0; i < 3; ++i) {
    test.pen.sample(state_with({test.place.x() + 0.002, test.place.y(), 0.010}, DeviceStatus::stale));
  }
  CHECK(test.renderer.last().device_point == before.device_point);
  CHECK(test.renderer.last().state == InteractionState::writing);
  test.pen.at(test.place);
  CHECK(test.renderer.last().force.isApprox(before.force));
}

TEST_CASE("a single sample far away is rejected, a second one near it accepted", "[render]") {
  MidStroke test;
  const Vector3d away = test.place + Vector3d(1.0, 0.0, 0.0);
  CHECK(test.pen.sample(state_with(away)).status == TickStatus::bad_sample);
  test.pen.at(test.place);
  CHECK(test.renderer.last().status == TickStatus::ok);
  CHECK(test.renderer.last().state == InteractionState::writing);
  CHECK(test.pen.sample(state_with(away)).status == TickStatus::bad_sample);
  CHECK(test.pen.sample(state_with(away)).status == TickStatus::ok);
  CHECK(test.renderer.last().state == InteractionState::adjusting);
  CHECK(test.pen.max_unexplained <= 1e-12);
}

TEST_CASE("a wrong sample, or noise of half a millimetre, changes the force on a pen at rest as docs/stability.md says",
          "[render]") {
  constexpr int draws = calligraphy_test::sanitized ? 3 : 200;
  struct Row {
    double max_acceleration, rate, wrong_sample, noise;  // [N per tick]
  };
  for (const Row& row : {Row{infinity, 100, 4.8, 1.3}, Row{infinity, 1000, 4.1, 3.8}, Row{infinity, 10'000, 1.2, 1.2},
                         Row{100, 100, 4.8, 1.3}, Row{100, 1000, 0.55, 0.5}, Row{100, 10'000, 0.45, 0.35}}) {
    double wrong_sample = 0.0, noise = 0.0;
    for (Capabilities device : device_profiles()) {
      for (const bool everything : {false, true}) {
        device.update_rate = row.rate;
        RendererOptions options = RendererOptions::for_device(device);
        if (everything) options = RendererOptions::everything(device);
        options.energy.budget = infinity;  // it would take from the force
        options.limits.max_acceleration = row.max_acceleration;
        MidStroke test(options, device);
        Sequence random(9);
        const auto among = [&](double size) {
          Vector3d drawn;
          for (double& coordinate : drawn) coordinate = random.between(-size, size);
          return drawn;
        };
        const auto largest_step = [&](int samples, auto&& displacement) {
          test.rest(static_cast<int>(0.05 * row.rate));
          test.pen.max_step = 0.0;
          for (int i = 0; i < samples; ++i) test.pen.at(test.place + displacement());
          test.pen.at(test.place);
          return test.pen.max_step;
        };
        for (int i = 0; i < draws; ++i) {
          wrong_sample = std::max(wrong_sample, largest_step(1, [&] {
                                    const double share = random.next();  // most of them near
                                    return Vector3d(0.006 * share * share * among(1.0).normalized());
                                  }));
          double away = 0.0;  // a pen that never was, and sets out
          const Vector3d there = among(1.0).normalized(), here = 4e-4 * random.next() * there;
          if (row.max_acceleration < infinity && row.rate > 100.0) {
            wrong_sample = std::max(wrong_sample, largest_step(i % 3 + 1, [&] {
                                      away = 3.0 * away + 1.0;
                                      return Vector3d(away * here);
                                    }));
          }
          noise = std::max(noise, largest_step(50, [&] { return among(0.0005); }));
        }
      }
    }
    CAPTURE(row.max_acceleration, row.rate);
    CHECK(wrong_sample < row.wrong_sample);
    CHECK(noise < row.noise);
    if (calligraphy_test::sanitized) continue;  // it draws too few to meet the worst
    CHECK(wrong_sample > 0.4 * row.wrong_sample);
    CHECK(noise > 0.4 * row.noise);
  }
}

TEST_CASE("clocks that stop, run backwards or jump change neither the force on a pen at rest nor its state",
          "[render]") {
  for (const double leap : {0.0, -1.0, -1e9, 10.0, 1e9, 1e300}) {
    MidStroke test;
    const Vector3d before = test.renderer.last().force;
    DeviceState state = state_with(test.place);
    state.time = test.renderer.last().time;
    for (int i = 0; i < 20; ++i) {
      state.time += leap;
      CHECK((test.renderer.update(state).force - before).norm() < 1e-9);  // what is left of the filtered velocity
    }
    CHECK(test.renderer.last().state == InteractionState::writing);
  }
}

TEST_CASE("on a moving pen clocks that stop, run backwards or jump change no state, and no force but the damping",
          "[render]") {
  for (const double leap : {0.0, -1.0, 0.0005, 0.004, 10.0, 1e300}) {
    for (const bool is_damped : {false, true}) {
      RendererOptions options;
      options.contact.lift_clearance = 0.0005;  // only the height decides on a lift, not its time
      if (!is_damped) {
        options.guidance.damping = options.paper.damping = 0.0;
        options.stiffness_check = StiffnessCheck::off;
      }
      HapticRenderer renderer({placed(U'三')}, {}, test_device(), options),
          other({placed(U'三')}, {}, test_device(), options);
      ScriptedPen pen(renderer);
      double clock = 0.0, difference = 0.0, springs = 0.0, damped = 0.0;
      int states = 0, written = 0, ticks = 0;
      pen.on_tick = [&](const HapticTick& tick) {
        DeviceState state = state_with(tick.device_point);
        state.time = clock += ++ticks % 40 == 0 ? 0.001 : leap;  // without a rest, leaps are no clock in seconds
        const HapticTick& twin = other.update(state);
        states += twin.state != tick.state || twin.events != tick.events || twin.stroke != tick.stroke;
        springs = std::max({springs, (twin.attraction - tick.attraction).norm(),
                            std::abs(twin.normal - twin.viscous.z() - tick.normal + tick.viscous.z())});
        // A clock that is slow or stands still makes no motion faster than a period does.
        damped = std::max(damped, twin.viscous.norm() - tick.viscous.norm());
        if (!is_damped || leap <= 0.0005) difference = std::max(difference, (twin.force - tick.force).norm());
        written += tick.state == InteractionState::writing;
      };
      pen.write(renderer.page()[0], 0.002);
      CAPTURE(leap, is_damped);
      CHECK(renderer.last().character == 1);
      CHECK(written > 500);
      CHECK(states == 0);
      CHECK(springs < 1e-12);
      CHECK(difference < 1e-12);
      if (leap <= 0.0005) CHECK(damped < 1e-12);
    }
  }
}

TEST_CASE("a clock that is not in seconds is told within 50 samples and takes the force away, at every rate", "[render]") {
  for (const double rate : {100.0, 1000.0, 20'000.0}) {
    for (const double unit : {1e3, 1e6, 1e9}) {  // milliseconds, microseconds, nanoseconds
      RendererOptions options;
      options.servo_rate = rate;
      options.stiffness_check = StiffnessCheck::clip;
      MidStroke test(options);
      REQUIRE(test.renderer.last().force.norm() > 0.05);
      DeviceState state = state_with(test.place);
      int untold = 0;
      for (int i = 1; i < 50 + static_cast<int>(rate); ++i) {
        state.time = unit * i / rate;
        const HapticTick& tick = test.renderer.update(state);
        if (i > 50) untold += tick.status != TickStatus::bad_clock;
      }
      CAPTURE(rate, unit);
      CHECK(untold == 0);
      CHECK(test.renderer.last().force == Vector3d(0, 0, 0));
      state.time = 0.0;
      test.renderer.update(state);
      CHECK(test.renderer.last().status == TickStatus::ok);
    }
  }
}

TEST_CASE("no sequence of samples makes the force step, exceed the peak or lose finiteness", "[render]") {
  std::vector<RendererOptions> all(5);
  all[1].contact.lift_between_strokes = false;
  all[2] = RendererOptions::wang2006();
  all[2].limits = {};
  all[3].guidance.force = [](const GuidanceInput& in) -> Point { return -1e4 * in.way; };
  all[4].limits.max_speed = 100.0;
  for (std::size_t i = 1; i < all.size(); ++i) all[i].limits.max_acceleration = infinity;
  for (std::size_t i = 0; i < all.size(); ++i) {
    HapticRenderer renderer({placed(U'永'), placed(U'北', {0.03, 0.02})}, {}, test_device(), all[i]);
    INFO("options " << i);
    ScriptedPen pen(renderer);
    const auto path =
        calligraphy_test::path_of(strokes(renderer.page()[0].character)[0], renderer.page()[0].placement, 0.0001);
    pen.go({path[0].x(), path[0].y(), 0.005});
    for (std::size_t k = 0; k < 30; ++k) pen.go({path[k].x(), path[k].y(), -0.002});
    CHECK(renderer.last().state == InteractionState::writing);  // initially these samples hit a stroke in progress
    double max_excess = -infinity;
    int not_finite = 0;
    torment(renderer, 17 + i, torment_ticks, max_excess, not_finite);
    CHECK(not_finite == 0);
    CHECK(max_excess <= 1e-12);
  }
}

TEST_CASE("huge velocities leave the pen tip of eq. (3) finite", "[render]") {
  RendererOptions options = RendererOptions::wang2006();
  HapticRenderer renderer({placed(U'永')}, {}, test_device(), options);
  DeviceState state = state_with({0.03, 0.05, -0.001});
  int not_finite = 0;
  for (int i = 0; i < 1000; ++i) {
    state.time = 0.1 * i;
    state.velocity = Vector3d(i % 2 ? 1.7e308 : 1e300, 1.7e308, -1.7e308);
    const HapticTick& tick = renderer.update(state);
    not_finite += !tick.force.allFinite() || !tick.device_point.allFinite();
  }
  CHECK(not_finite == 0);
}

TEST_CASE("without stiffness and damping there is no force, whatever the pen does", "[render]") {
  RendererOptions options;
  options.paper.stiffness = options.guidance.stiffness = options.guidance.wrong_way_stiffness = 0.0;
  options.paper.damping = options.guidance.damping = 0.0;
  HapticRenderer renderer({placed(U'永')}, {}, test_device(), options);
  ScriptedPen pen(renderer);
  pen.write(renderer.page()[0], 0.002);
  CHECK(pen.max_force == 0.0);
  CHECK(renderer.last().character == 1);
}

TEST_CASE("a page and a device far from their origins behave like those nearby", "[render]") {
  MotionMapping mapping;
  mapping.offset = {500.0, -300.0, 20.0};
  HapticRenderer renderer({placed(U'永', {500.02, -300.05})}, mapping, test_device());
  ScriptedPen pen(renderer);
  pen.write(renderer.page()[0], 0.001);
  CHECK(renderer.last().character == 1);
  CHECK(pen.max_unexplained <= 1e-12);
}

TEST_CASE("a pause before bad samples is charged once, not with each of them", "[render]") {
  Capabilities device = calligraphy_test::test_device();
  device.apparent_mass = 0.045;
  RendererOptions options;
  options.energy.budget = 0.1;
  options.stiffness_check = StiffnessCheck::clip;
  const auto given = [&](int bad) {
    HapticRenderer renderer({calligraphy_test::placed(U'永')}, {}, device, options);
    DeviceState state;
    state.position = {0.04, 0.04, -0.002};
    for (int i = 0; i < 100; ++i) {
      state.time = 0.001 * i;
      renderer.update(state);
    }
    state.time += 0.05;  // 49 ticks missed, in which the force fell to zero
    state.force.setZero();
    const Eigen::Vector3d place = state.position;
    state.position.setConstant(std::numeric_limits<double>::quiet_NaN());
    for (int i = 0; i < bad; ++i) {
      renderer.update(state);
      state.time += 0.001;
    }
    state.position = place;
    renderer.update(state);
    return renderer.last().energy_given;
  };
  REQUIRE(given(1) > 0.01);
  CHECK(given(10) == Approx(given(1)).epsilon(1e-9));
}
