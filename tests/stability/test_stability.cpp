// Hands that the renderer has not met, on an independent simulation: a few of the cases of guidance_sweep and
// energy_account, which run thousands.
#include <numbers>

#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/render/detail/energy_observer.hpp>

#include "catch.hpp"
#include "energy.hpp"
#include "issue_cases.hpp"
#include "sweep.hpp"

namespace calligraphy_test {
namespace {

constexpr int drawn_cases = 150, grips = 40, energy_runs = 40;
constexpr std::int64_t energy_ticks = 20000;

void check_sweep(std::uint64_t seed) {
  const std::vector<SweepResult> results = run_sweep(seed, drawn_cases, 0);
  int soft = 0, quick = 0;
  for (int i = 0; i < drawn_cases; ++i) {
    const SweepResult& result = results[static_cast<std::size_t>(i)];
    const SweepCase drawn = draw_case(seed, i);
    if (drawn.device.sample_delay <= 1 && drawn.device.update_rate >= 1000.0) {
      ++quick;
      soft += result.refused || result.clipped_soft();
    }
    INFO(describe(drawn) << "\n" << describe(result));
    CHECK_FALSE(result.refused);
    CHECK_FALSE(result.fails());
  }
  CHECK(soft <= 0.05 * quick);
}

calligraphy::Capabilities point_mass(double damping) {
  calligraphy::Capabilities device;
  device.apparent_mass = 0.045;
  device.viscous_friction = damping;
  return device;
}

HandAction no_hand(double, const Vector3d&, const Vector3d&) { return {}; }

/// Peak to peak in the last tenth of 3 s over that in the first, on a wall with a zero-order hold.
double growth(double stiffness, double damping, double period, int delay) {
  calligraphy::Capabilities mass = point_mass(damping);
  mass.sample_delay = delay;
  IndependentDevice device(mass, Vector3d(0.001, 0.0, 0.0));
  Extent first, last;
  const int ticks = static_cast<int>(3.0 / period);
  for (int tick = 0; tick < ticks; ++tick) {
    device.write(-stiffness * device.read().position);
    device.advance(period, no_hand);
    if (tick < ticks / 10) first.add(device.position());
    if (tick >= ticks - ticks / 10) last.add(device.position());
  }
  return last.size().x() / first.size().x();
}

}  // namespace

TEST_CASE("the judge: a sampled wall becomes unstable where the exact solution says", "[stability]") {
  // Critical stiffness of 45 g: damping, period, delay, K.
  const auto [damping, period, delay, critical] = GENERATE(table<double, double, int, double>({{0.1, 1e-3, 0, 200.1},
                                                                                               {0.5, 1e-3, 0, 1001.9},
                                                                                               {0.5, 10e-3, 0, 101.9},
                                                                                               {0.5, 1e-3, 1, 334.4},
                                                                                               {0.5, 1e-3, 5, 91.8}}));
  CAPTURE(damping, period, delay);
  CHECK(growth(1.02 * critical, damping, period, delay) > 1.02);
  CHECK(growth(0.98 * critical, damping, period, delay) < 0.98);
}

TEST_CASE("the judge: the work of a force is the force times the way, and ends as motion and friction", "[stability]") {
  calligraphy::Capabilities mass = point_mass(0.0);
  mass.coulomb_friction = 0.2;
  IndependentDevice device(mass, Vector3d::Zero());
  device.write({1.0, 0.0, 0.0});
  for (int tick = 0; tick < 100; ++tick) device.advance(0.001, no_hand);
  const double way = device.position().x(), speed = device.velocity().x();
  CHECK(way == Approx(0.5 * 0.8 / 0.045 * 0.01).epsilon(1e-3));
  CHECK(device.energy_given() == Approx(way).epsilon(1e-9));
  CHECK(0.5 * 0.045 * speed * speed == Approx(0.8 * way).epsilon(1e-3));
  device.write(Vector3d::Zero());
  for (int tick = 0; tick < 500; ++tick) device.advance(0.001, no_hand);
  CHECK(device.velocity().x() == 0.0);
  CHECK(device.position().x() == Approx(way / 0.2).epsilon(1e-3));  // all of 1 N over that way, against 0.2 N
  CHECK(device.energy_given() == Approx(way).epsilon(1e-9));
}

TEST_CASE("the judge: Coulomb friction holds a pen at rest up to its value, and a weak spring does not end it",
          "[stability]") {
  calligraphy::Capabilities mass = point_mass(0.1);
  mass.coulomb_friction = 0.26;
  IndependentDevice device(mass, Vector3d::Zero());
  device.write({0.25, -0.25, 0.0});
  device.advance(0.1, no_hand);
  CHECK(device.position() == Vector3d::Zero());
  device.write({0.27, -0.25, 0.0});
  device.advance(0.1, no_hand);
  CHECK(device.position().x() == Approx(0.5 * 0.01 / 0.045 * 0.01).epsilon(0.1));
  CHECK(device.position().y() == 0.0);
}

TEST_CASE("the judge: a swinging grip keeps its frequency and its energy", "[stability]") {
  IndependentDevice device(point_mass(0.0), Vector3d(0.01, 0.0, 0.0));
  const GripImpedance grip = {0.1, 0.0, 300.0};
  const auto hand = [&](double, const Vector3d& position, const Vector3d& velocity) {
    return HandAction{grip_force(grip, Vector3d::Zero(), Vector3d::Zero(), position, velocity), grip.mass};
  };
  const double period = 2.0 * std::numbers::pi * std::sqrt(0.145 / 300.0);
  device.advance(10.0 * period, hand);
  CHECK(device.position().x() == Approx(0.01).epsilon(1e-3));
  CHECK(std::abs(device.velocity().x()) < 1e-3);
}

TEST_CASE("the judge: a sample is as old as the device says, rounded to its encoder", "[stability]") {
  calligraphy::Capabilities mass = point_mass(0.0);
  mass.sample_delay = 2;
  mass.encoder_step = 1e-3;
  IndependentDevice device(mass, Vector3d::Zero());
  device.write({0.045, 0.0, 0.0});  // 1 m/s^2
  for (int tick = 0; tick < 5; ++tick) device.advance(0.1, no_hand);
  const DeviceState state = device.read();
  CHECK(state.time == Approx(0.3));
  CHECK(state.velocity.x() == Approx(0.3));
  CHECK(state.position.x() == Approx(0.045).margin(1e-9));
}

TEST_CASE("hands drawn at random come to rest beside their twins after a disturbance", "[stability]") {
  check_sweep(1);
}

TEST_CASE("hands drawn from another seed come to rest too", "[stability]") { check_sweep(20260); }

TEST_CASE("every named case of guidance that once drove the pen comes to rest", "[stability]") {
  for (const IssueFigure& row : issue_figures(0, grips)) {
    INFO(row.name << ": " << row.measured << ", once " << row.reported);
    CHECK(row.right);
  }
}

TEST_CASE("a law of which nothing is known gives no more than the presumed budget, however it misbehaves",
          "[stability]") {
  for (const char* const name : {"stiff", "along", "away"}) {
    const auto results = run_sweep(14, drawn_cases / 3, 0, nullptr,
                                   [&](SweepCase& drawn) { drawn.options.guidance.force = strange_law(name); });
    for (const SweepResult& result : results) {
      INFO(name << ": " << describe(result) << ", " << result.energy << " J");
      CHECK_FALSE(result.refused);
      CHECK(result.energy <= 0.1);
    }
  }
}

TEST_CASE("a law gives no more than its budget by forces that change while the encoder stands", "[stability]") {
  using namespace calligraphy;
  // A normal force that changes its sign every 8 ms, and a hand that moves within a step of the encoder in time with it.
  int tick = 0;
  RendererOptions options;
  options.guidance.force = [&tick](const GuidanceInput&) -> GuidanceTerms {
    return {{0.0, 0.0}, {0.0, 0.0}, tick / 8 % 2 == 0 ? 2.0 : -2.0};
  };
  const Capabilities omni = device_profile("omni");
  const PlacedCharacter placed = in_the_middle(*built_in_characters().find(U'一'), 1.0);
  HapticRenderer renderer({placed}, upright_page(page_width, page_height), omni, options);
  const Point start = placed.placement.to_page(strokes(placed.character)[0].control_points.front());
  const double middle = -0.002, hidden = 0.45 * omni.encoder_step;
  double given = 0.0, most = 0.0, place = middle;
  for (tick = 0; tick < 180'000; ++tick) {
    DeviceState state;
    state.time = 0.001 * tick;
    const double shown = omni.encoder_step * std::round(middle / omni.encoder_step);
    state.position = renderer.mapping().to_device({start.x() + 0.002, start.y(), tick < 50 ? 0.005 : shown});
    const double force = renderer.update(state).page_force.z();
    const double next = middle + (force > 0.0 ? hidden : -hidden);
    if (tick > 60) given += force * (next - place);
    place = next;
    most = std::max(most, given);
  }
  CAPTURE(given, most);
  CHECK(most <= 0.1);
}

TEST_CASE("no hand gets more energy than the budget, whatever it tries and however the ticks come", "[stability]") {
  const auto profiles = calligraphy::device_profiles();
  for (int i = 0; i < energy_runs; ++i) {
    const auto n = static_cast<std::size_t>(i);
    EnergyRun run;
    run.device = profiles[n % profiles.size()];
    run.device.sample_delay = i % (calligraphy::detail::EnergyObserver::max_delay + 1);
    run.hand = static_cast<EnergyHand>(7 * n % energy_hand_names.size());
    run.timing = static_cast<Timing>(n / 5 % static_cast<std::size_t>(Timing::idle_watchdog));
    run.servo = i % 2 == 1;
    run.ticks = energy_ticks;
    const EnergyResult result = run_energy(run);
    INFO(run.device.name << ", delay " << run.device.sample_delay << ", hand "
                         << energy_hand_names[static_cast<std::size_t>(run.hand)] << ", timing "
                         << timing_names[static_cast<std::size_t>(run.timing)] << (run.servo ? ", servo" : ", alone")
                         << ": given " << result.most_given << " J, claimed " << result.most_claimed << " J "
                         << result.refusal);
    CHECK_FALSE(result.over());
  }
}

TEST_CASE("no hand gets more energy than the budget in minutes, by a force that is late or chatters with the encoder",
          "[stability]") {
  struct Case {
    const char* profile;
    int delay;
    EnergyHand hand;
    bool servo;
  };
  for (const Case& each : {Case{"touch", 15, EnergyHand::shaking, false}, Case{"ideal", 5, EnergyHand::shaking, true},
                           Case{"premium-1.5", 7, EnergyHand::greedy, false}}) {
    EnergyRun run;
    run.device = calligraphy::device_profile(each.profile);
    run.device.sample_delay = each.delay;
    run.hand = each.hand;
    run.servo = each.servo;
    run.ticks = 300000;
    run.seed = 2;
    const EnergyResult result = run_energy(run);
    INFO(each.profile << ", delay " << each.delay << ": given " << result.most_given << " J");
    CHECK_FALSE(result.over());
    CHECK(result.most_given > 0.8 * run.budget);
  }
}

TEST_CASE("no hand gets more energy than the budget from a force that worked while loop and watchdog were late",
          "[stability]") {
  const auto profiles = calligraphy::device_profiles();
  for (int i = 0; i < energy_runs; ++i) {
    const auto n = static_cast<std::size_t>(i);
    EnergyRun run;
    run.device = profiles[n % profiles.size()];
    run.device.sample_delay = i % (calligraphy::detail::EnergyObserver::max_delay + 1);
    run.hand = static_cast<EnergyHand>(7 * n % energy_hand_names.size());
    run.timing = i % 2 == 0 ? Timing::idle_watchdog : Timing::starved_watchdog;
    run.servo = true;
    run.ticks = energy_ticks;
    const EnergyResult result = run_energy(run);
    INFO(run.device.name << ", delay " << run.device.sample_delay << ", hand " << 7 * n % energy_hand_names.size()
                         << ", timing " << timing_names[static_cast<std::size_t>(run.timing)] << ": given "
                         << result.most_given << " J, rise " << result.most_rise << " J");
    CHECK_FALSE(result.over());
    CHECK(result.most_rise <= run.budget);  // however long the gaps: every force has been counted
  }
}

}  // namespace calligraphy_test
