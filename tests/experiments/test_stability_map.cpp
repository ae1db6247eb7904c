#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include <pugixml.hpp>

#include <calligraphy/base/error.hpp>
#include <calligraphy/devices/simulated_device.hpp>
#include <calligraphy/experiments/stability_map.hpp>
#include <calligraphy/pictures/plot.hpp>

#include "../catch.hpp"
#include "../special_values.hpp"

using namespace calligraphy;

namespace {

using calligraphy_test::not_a_number;
const GripImpedance nobody{0.0, 0.0, 0.0};

SampledLoop loop_of(double rate, double damping, int delay = 0, double wall_damping = 0.0,
                    const GripImpedance& grip = nobody) {
  SampledLoop loop;
  loop.rate = rate;
  loop.device = StabilityMapOptions::point_mass();
  loop.device.viscous_friction = damping;
  loop.device.sample_delay = delay;
  loop.wall_damping = wall_damping;
  loop.grip = grip;
  return loop;
}

/// Whether the oscillation of a simulated device on a bilateral wall grows, from early and late amplitudes.
bool grows(const SampledLoop& loop, double stiffness) {
  Capabilities endless = loop.device;
  endless.peak_force = std::numeric_limits<double>::infinity();
  SimulatedDevice device(endless, loop.grip, {1e-3, 0.0, 0.0});
  device.set_intention({});
  constexpr int ticks = 20000;
  double previous = 1e-3, early = 0.0, late = 0.0;
  for (int tick = 0; tick < ticks; ++tick) {
    const double x = device.read().position.x();
    device.write({-stiffness * x - loop.wall_damping * (x - previous) * loop.rate, 0.0, 0.0});
    previous = x;
    device.advance(1.0 / loop.rate);
    if (std::abs(x) > 10.0) return true;
    if (tick >= ticks / 4 && tick < ticks / 2) early = std::max(early, std::abs(x));
    if (tick >= ticks * 3 / 4) late = std::max(late, std::abs(x));
  }
  return late > early;
}

StabilityMapOptions small_map() {
  StabilityMapOptions options;
  options.contact.seconds = 0.5;
  options.per_decade = 2;
  options.min_stiffness = 30.0;
  options.max_stiffness = 3000.0;
  options.dampings = {0.1, 2.0};
  options.rates = {500.0};
  options.delays = {0, 2};
  options.encoder_steps = {0.0, 55e-6};
  options.wall_dampings = {0.0};
  options.grips = {nobody, {0.1, 3.0, 300.0}};
  return options;
}

WallContact controlled() {
  WallContact contact;
  contact.controlled = true;
  return contact;
}

}  // namespace

TEST_CASE("oscillations grow just above the critical stiffness and decay just below it", "[stability map]") {
  const double rate = GENERATE(200.0, 1000.0, 10000.0);
  const double damping = GENERATE(0.3, 3.0);
  const int delay = GENERATE(0, 1, 5);
  for (const double wall_damping : {0.0, 0.5, 8.0}) {
    for (const GripImpedance& grip : {nobody, GripImpedance{0.1, 3.0, 300.0}}) {
      const SampledLoop loop = loop_of(rate, damping, delay, wall_damping, grip);
      const double critical = critical_stiffness(loop);
      CAPTURE(rate, damping, delay, wall_damping, grip.stiffness, critical);
      if (critical == 0.0) {
        CHECK(grows(loop, 1e-3));  // the damping of the wall alone is too high for this rate and delay
        continue;
      }
      CHECK(grows(loop, 1.05 * critical));
      CHECK_FALSE(grows(loop, 0.95 * critical));
    }
  }
}

TEST_CASE("a pen that falls onto a wall settles up to the critical stiffness of the linear loop", "[stability map]") {
  const double damping = GENERATE(0.05, 0.1, 0.5, 2.0);
  const int delay = GENERATE(0, 1, 2, 5);
  for (const GripImpedance& grip : {nobody, GripImpedance{0.1, 3.0, 300.0}}) {
    const SampledLoop loop = loop_of(1000.0, damping, delay, 0.0, grip);
    const double critical = critical_stiffness(loop);
    CAPTURE(damping, delay, grip.stiffness, critical);
    CHECK(simulate_wall_contact(loop, 0.96 * critical).stable);
    CHECK_FALSE(simulate_wall_contact(loop, 1.04 * critical).stable);
  }
}

TEST_CASE("an oscillation that decays to a limit cycle has not settled", "[stability map]") {
  const double seconds = GENERATE(4.0, 12.0, 60.0);
  WallContact contact;
  contact.seconds = seconds;
  CAPTURE(seconds);
  const GripImpedance grip{0.1, 3.0, 300.0};
  CHECK_FALSE(simulate_wall_contact(loop_of(500.0, 0.1, 0, 0.0, grip), std::pow(10.0, 4.5), contact).stable);
  SampledLoop rounded = loop_of(2000.0, 2.0, 0, 0.0, grip);
  rounded.device.encoder_step = 23e-6;
  rounded.device.coulomb_friction = 0.06;
  CHECK_FALSE(simulate_wall_contact(rounded, std::pow(10.0, 4.75), contact).stable);
  // One that decays slowly all the time, by 2.6 % in the last quarter of the first 4 s, settles.
  CHECK(simulate_wall_contact(loop_of(4000.0, 0.2, 2), std::pow(10.0, 2.5), contact).stable);
}

TEST_CASE("with the passivity controller a wall ten times as stiff settles below the peak force", "[stability map]") {
  const SampledLoop loop = loop_of(1000.0, 0.1);
  const double critical = critical_stiffness(loop);
  CHECK(critical == Approx(200.1).epsilon(0.001));
  CHECK_FALSE(simulate_wall_contact(loop, 1.04 * critical).stable);
  for (double stiffness = 20.0; stiffness <= 20.0 * critical; stiffness *= 1.25) {
    // Within the peak force of an Omni, and, from a greater height, at 0.2 m/s, of a Desktop.
    for (const auto& [height, peak] : {std::pair(0.0, 3.3), std::pair(0.00025, 3.3), std::pair(0.001, 7.9)}) {
      WallContact contact = controlled();
      contact.height = height;
      CAPTURE(stiffness, height);
      const WallContactResult outcome = simulate_wall_contact(loop, stiffness, contact);
      CHECK(outcome.stable);
      CHECK(outcome.max_force < peak);
      CHECK(outcome.last_force == Approx(contact.push).epsilon(0.1));
    }
  }
}

TEST_CASE("on a wall with damping, the controller at its limit neither gains nor loses stability", "[stability map]") {
  const SampledLoop loop = loop_of(1000.0, 0.1, 0, 20.0);
  CHECK(simulate_wall_contact(loop, 0.95 * critical_stiffness(loop)).stable);
  CHECK(simulate_wall_contact(loop, 0.95 * critical_stiffness(loop), controlled()).stable);
}

TEST_CASE("at the advised stiffness no encoder step sustains an oscillation", "[stability map]") {
  const double step = GENERATE(1e-6, 23e-6, 55e-6, 200e-6);
  const double friction = GENERATE(0.06, 0.26);
  const double damping = GENERATE(0.1, 1.0, 5.0);  // at 5 N s/m dry friction is the tighter bound for a coarse encoder
  SampledLoop loop = loop_of(1000.0, damping);
  loop.device.encoder_step = step;
  loop.device.coulomb_friction = friction;
  const double passive = advise_stiffness(loop).passive.value;
  const double held = 2.0 * friction / step;  // quantisation held by dry friction
  CHECK(advise_stiffness(loop).quantised.value == Approx(std::min(passive, held)));
  for (const bool with_control : {false, true}) {
    WallContact contact;
    contact.controlled = with_control;
    const double advised = std::min(passive, held);
    CAPTURE(step, friction, damping, advised, with_control);
    const WallContactResult outcome = simulate_wall_contact(loop, advised, contact);
    CHECK(outcome.stable);
    CHECK(outcome.peak_to_peak < 1e-7);
  }
}

TEST_CASE("quantisation that dry friction does not hold sustains an oscillation on a passive wall", "[stability map]") {
  SampledLoop loop = loop_of(1000.0, 5.0);
  const double step = GENERATE(23e-6, 55e-6, 200e-6);
  CHECK(simulate_wall_contact(loop, 5000.0).stable);  // half of what is passive
  loop.device.encoder_step = step;
  loop.device.coulomb_friction = 0.06;
  const double held = advise_stiffness(loop).quantised.value;
  CAPTURE(step, held);
  CHECK(simulate_wall_contact(loop, held).stable);
  CHECK_FALSE(simulate_wall_contact(loop, 1.5 * held).stable);
  loop.device.coulomb_friction = 0.0;
  CHECK(advise_stiffness(loop).quantised.value == 0.0);
  CHECK_FALSE(simulate_wall_contact(loop, 9000.0).stable);
}

TEST_CASE("with quantised positions, what settles without control also settles with it", "[stability map]") {
  const double rate = GENERATE(1000.0, 4000.0);
  const double step = GENERATE(23e-6, 55e-6);
  for (const double wall_damping : {0.0, 1.0}) {
    SampledLoop loop = loop_of(rate, 0.1, 0, wall_damping);
    loop.device.encoder_step = step;
    loop.device.coulomb_friction = 0.06;
    for (double stiffness = 10.0; stiffness < 1e5; stiffness *= 2.0) {
      CAPTURE(rate, step, wall_damping, stiffness);
      if (simulate_wall_contact(loop, stiffness).stable)
        CHECK(simulate_wall_contact(loop, stiffness, controlled()).stable);
    }
  }
}

TEST_CASE("from 100 Hz to 20 kHz a passive wall settles, with and without control", "[stability map]") {
  const double rate = GENERATE(100.0, 500.0, 1000.0, 4000.0, 10000.0, 20000.0);
  const SampledLoop loop = loop_of(rate, 0.5);
  const double passive = advise_stiffness(loop).passive.value;
  WallContact contact;
  contact.seconds = rate > 4000.0 ? 4.0 : 12.0;
  CAPTURE(rate, passive);
  CHECK(simulate_wall_contact(loop, 0.95 * passive, contact).stable);
  contact.controlled = true;
  CHECK(simulate_wall_contact(loop, 0.95 * passive, contact).stable);
}

TEST_CASE("with samples 0 to 5 ticks late, lost or reordered, a wall that tolerates one more tick of delay is stable",
          "[stability map]") {
  const int delay = GENERATE(0, 1, 2, 3, 4, 5);
  const SampledLoop loop = loop_of(1000.0, 0.5, delay);
  SampledLoop later = loop;
  later.device.sample_delay = delay + 1;
  const double stiffness = 0.95 * critical_stiffness(later);
  for (const double share : {0.0, 0.01, 0.2}) {
    for (const bool with_control : {false, true}) {
      WallContact contact;
      contact.controlled = with_control;
      contact.lost = contact.reordered = share;
      CAPTURE(delay, share, with_control, stiffness);
      CHECK(simulate_wall_contact(loop, stiffness, contact).stable);
    }
  }
}

TEST_CASE("lost or reordered samples reduce the stable stiffness", "[stability map]") {
  const SampledLoop loop = loop_of(1000.0, 0.5);
  const double stiffness = 0.95 * critical_stiffness(loop);
  WallContact contact;
  CHECK(simulate_wall_contact(loop, stiffness, contact).stable);
  contact.lost = 0.3;
  CHECK_FALSE(simulate_wall_contact(loop, stiffness, contact).stable);
  contact.lost = 0.0;
  contact.reordered = 0.3;
  CHECK_FALSE(simulate_wall_contact(loop, stiffness, contact).stable);
}

TEST_CASE("the wall force is clipped at the peak force of the device", "[stability map]") {
  WallContact contact;
  contact.height = 0.01;
  SampledLoop loop = loop_of(1000.0, 5.0);
  loop.device.peak_force = 2.0;
  CHECK(simulate_wall_contact(loop, 5000.0, contact).max_force == 2.0);
  loop.device.force_step = 0.3;
  CHECK(simulate_wall_contact(loop, 5000.0, contact).max_force == Approx(1.8));  // the largest multiple below it
  loop.device.peak_force = 50.0;
  CHECK(simulate_wall_contact(loop, 5000.0, contact).max_force > 2.0);
}

TEST_CASE("the wall force is rounded to the force steps of the device, the push of the hand is not",
          "[stability map]") {
  WallContact contact;
  contact.push = 0.5;
  SampledLoop loop = loop_of(1000.0, 5.0);
  loop.device.force_step = 0.2;
  // No multiple of 0.2 N balances 0.5 N: the pen goes to and fro between two of them.
  const WallContactResult outcome = simulate_wall_contact(loop, 500.0, contact);
  CHECK_FALSE(outcome.stable);
  CHECK(outcome.last_force == Approx(0.6));
  contact.push = 0.4;
  CHECK(simulate_wall_contact(loop, 500.0, contact).stable);
}

TEST_CASE("on a wall without stiffness the pen does not settle", "[stability map]") {
  const WallContactResult outcome = simulate_wall_contact(loop_of(1000.0, 0.1), 0.0);
  CHECK_FALSE(outcome.stable);
  CHECK(outcome.max_force == 0.0);
}

TEST_CASE("the map has every combination with its bounds and stable stiffnesses", "[stability map]") {
  const StabilityMap map = stability_map(small_map());
  REQUIRE(map.stiffnesses.size() == 5);
  CHECK(map.stiffnesses.back() == Approx(3000.0));
  CHECK(map.grid.size() == 2u * 1u * 2u * 2u * 1u * 2u);
  CHECK(map.sweeps.size() == 6);
  const auto check = [&](const StabilityLine& line) {
    CHECK(line.stable_at.size() == map.stiffnesses.size());
    CHECK(line.controlled_stable_at.size() == map.stiffnesses.size());
    CHECK(line.stable == critical_stiffness(line.loop));
    CHECK(line.passive == advise_stiffness(line.loop).passive.value);
    CHECK(line.controlled_max_stable_below_peak <= line.controlled_max_stable);
    for (std::size_t i = 0; i < map.stiffnesses.size() && map.stiffnesses[i] <= line.max_stable; ++i) {
      CHECK(line.stable_at[i]);
    }
  };
  for (const StabilityLine& line : map.grid) check(line);
  for (const StabilitySweep& sweep : map.sweeps) {
    CAPTURE(sweep.name);
    REQUIRE(sweep.values.size() == sweep.lines.size());
    for (const StabilityLine& line : sweep.lines) check(line);
  }
  const StabilityMap again = stability_map(small_map());
  for (std::size_t i = 0; i < map.grid.size(); ++i) {
    CHECK(again.grid[i].max_stable == map.grid[i].max_stable);
    CHECK(again.grid[i].controlled_max_stable == map.grid[i].controlled_max_stable);
    CHECK(again.grid[i].stable_at == map.grid[i].stable_at);
  }
}

TEST_CASE("the maximum stable stiffness is found to 2 %", "[stability map]") {
  StabilityMapOptions options = small_map();
  options.with_sweeps = false;
  options.contact.seconds = 12.0;
  options.min_stiffness = 10.0;
  options.encoder_steps = {0.0};
  options.grips = {nobody};
  for (const StabilityLine& line : stability_map(options).grid) {
    CAPTURE(line.loop.device.viscous_friction, line.loop.device.sample_delay);
    CHECK(line.max_stable == Approx(std::min(line.stable, 3162.3)).epsilon(0.04));
  }
}

TEST_CASE("a contact or a map out of its domain is rejected", "[stability map]") {
  const auto refused = [](auto change) {
    WallContact contact;
    change(contact);
    CHECK_THROWS_AS(simulate_wall_contact(loop_of(1000.0, 0.1), 100.0, contact), ValueError);
  };
  for (const double bad : {-1.0, not_a_number}) {
    refused([bad](WallContact& e) { e.push = bad; });
    refused([bad](WallContact& e) { e.height = bad; });
    refused([bad](WallContact& e) { e.seconds = bad; });
    SampledLoop weak = loop_of(1000.0, 0.1);
    weak.device.peak_force = bad;
    CHECK_THROWS_AS(simulate_wall_contact(weak, 100.0), ValueError);
    refused([bad](WallContact& e) { e.lost = bad; });
    refused([bad](WallContact& e) { e.reordered = bad; });
    CHECK_THROWS_AS(simulate_wall_contact(loop_of(1000.0, 0.1), bad), ValueError);
    CHECK_THROWS_AS(simulate_wall_contact(loop_of(bad, 0.1), 100.0), ValueError);
    StabilityMapOptions options = small_map();
    options.min_stiffness = bad;
    CHECK_THROWS_AS(stability_map(options), ValueError);
    options = small_map();
    options.max_stiffness = bad;
    CHECK_THROWS_AS(stability_map(options), ValueError);
    options = small_map();
    options.dampings.push_back(bad);
    CHECK_THROWS_AS(stability_map(options), ValueError);
  }
  StabilityMapOptions options = small_map();
  options.per_decade = 0;
  CHECK_THROWS_AS(stability_map(options), ValueError);
}

TEST_CASE("the plot of the map is valid XML and names the bounds", "[stability map]") {
  CHECK_THROWS_AS(stability_map_plot({}), ValueError);
  if (!gnuplot_available()) {
    if (std::getenv("CALLIGRAPHY_REQUIRE_DATA") != nullptr) FAIL("gnuplot cannot be started");
    WARN("skipped: gnuplot cannot be started");
    return;
  }
  StabilityMapOptions options = small_map();
  options.with_grid = false;
  options.contact.seconds = 0.1;
  StabilityMap map = stability_map(options);
  CHECK(map.grid.empty());
  map.sweeps[0].label = "a 'label'\nwith all that ends one";
  const std::string picture = stability_map_plot(map);
  pugi::xml_document document;
  REQUIRE(document.load_string(picture.c_str()));
  for (const char* word : {"passive", "stable, exact", "Gil et al. 2009", "settles only with control", "grip",
                           "servo rate [kHz]", "stiffness K [N/m]"}) {
    CHECK(picture.find(word) != std::string::npos);
  }
}
