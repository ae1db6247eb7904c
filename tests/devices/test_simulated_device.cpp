#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/base/random.hpp>
#include <calligraphy/devices/device_profiles.hpp>
#include <calligraphy/devices/servo.hpp>
#include <calligraphy/devices/simulated_device.hpp>

#include "../allocation_counter.hpp"
#include "../catch.hpp"
#include "../sanitized.hpp"
#include "../special_values.hpp"
#include "../still_clock.hpp"

using namespace calligraphy;

namespace {

using calligraphy_test::infinity;
using calligraphy_test::not_a_number;

Capabilities point_mass(double mass, double viscous_friction = 0.0, double coulomb_friction = 0.0) {
  Capabilities profile = device_profile("ideal");
  profile.apparent_mass = mass;
  profile.viscous_friction = viscous_friction;
  profile.coulomb_friction = coulomb_friction;
  return profile;
}

GripImpedance spring(double stiffness, double damping = 0.0) { return {0.0, damping, stiffness}; }

SimulatedDevice at_x(const Capabilities& profile, const GripImpedance& grip, double x) {
  SimulatedDevice device(profile, grip, {x, 0.0, 0.0});
  device.set_intention({});
  return device;
}

double x_of(const SimulatedDevice& device) { return device.true_position().x(); }
double v_of(const SimulatedDevice& device) { return device.true_velocity().x(); }

using Real = long double;

/// The equation of motion by its Taylor series, over steps that are short against every time constant and end where the
/// velocity vanishes: independent of the closed forms of the library.
struct Reference {
  Real mass, damping, stiffness, friction, x = 0, v = 0;

  /// m x'' = push + ramp t - d x' - k x, from x, v.
  Reference after(Real push, Real ramp, Real seconds) const {
    Reference end = *this;
    end.x = end.v = 0;
    Real term = x, next = v, power = 1;  // of t^n and t^(n+1), t^n
    for (int n = 0; n < 20; ++n, power *= seconds) {
      end.x += term * power;
      end.v += static_cast<Real>(n + 1) * next * power;
      const Real load = n == 0 ? push : n == 1 ? ramp : 0;
      const Real after_next = ((load - stiffness * term) / static_cast<Real>(n + 1) - damping * next) /
                              (mass * static_cast<Real>(n + 2));
      term = next;
      next = after_next;
    }
    return end;
  }

  void advance(Real force, Real target, Real speed, Real seconds) {
    const Real step = 0.03L / (damping / mass + std::sqrt(stiffness / mass) + 0.03L / seconds);
    const Real ramp = stiffness * speed;
    for (Real t = 0; t < seconds;) {
      Real push = force + stiffness * (target + speed * t);
      const Real pull = push - stiffness * x;
      Real direction = std::copysign(1.0L, v == 0 ? pull : v);
      if (v == 0 && std::abs(pull) <= friction) {  // held until the moving target breaks it away
        direction = std::copysign(1.0L, ramp);
        const Real held = ramp == 0 ? seconds : (direction * friction - pull) / ramp;
        if (held >= seconds - t) return;
        t += held;
        push = direction * friction + stiffness * x;
      }
      push -= direction * friction;
      Real length = std::min(step, seconds - t);
      Reference end = after(push, ramp, length);
      if (friction > 0 && direction * end.v < 0) {
        Real low = 0;
        for (int i = 0; i < 64; ++i) {
          const Real middle = (low + length) / 2;
          (direction * after(push, ramp, middle).v > 0 ? low : length) = middle;
        }
        end = after(push, ramp, length);
        end.v = 0;
      }
      *this = end;
      t += length;
    }
  }
};

std::string error_of(const Capabilities& profile, const GripImpedance& grip = {0.0, 0.0, 0.0},
                     const Eigen::Vector3d& position = Eigen::Vector3d::Zero()) {
  try {
    SimulatedDevice device(profile, grip, position);
  } catch (const ValueError& error) {
    return error.what();
  }
  return {};
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

bool same_bits(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::equal(a.begin(), a.end(), b.begin(), [](double left, double right) {
    return std::bit_cast<std::uint64_t>(left) == std::bit_cast<std::uint64_t>(right);
  });
}

}  // namespace

// ---- motion

TEST_CASE("any hand moves as the equation of motion says, however the time is cut into steps", "[devices]") {
  Random random(67);
  const auto scaled = [&](double low, double high) { return low * std::pow(high / low, random.next()); };
  const auto vector = [&] {
    return Eigen::Vector3d{random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
  };
  const auto often = [&](double share) { return random.next() < share; };
  constexpr double critical[] = {0.0, 1.0, 1.0 - 1e-13, 1.0 + 1e-13, 1.0 - 1e-9, 1.0 + 1e-9, 1.0 - 1e-6, 1.0 + 1e-6};
  constexpr double reach = 0.01;  // about as far as the forces move the hand in one swing [m]
  for (int run = 0; run < 1000; ++run) {
    const double mass = scaled(0.01, 1.0), frequency = scaled(1.0, 300.0), own = random.between(0.1, 1.0);
    const double ratio = often(0.4) ? critical[random.index(std::size(critical))] : scaled(1e-3, 30.0);
    const double damping = 2.0 * ratio * mass * frequency, of_hand = damping - own * damping;
    const double strength = reach * mass * frequency * frequency;
    const double stiffness = often(0.2) ? 0.0 : strength / reach;
    const double friction = often(0.5) ? 0.0 : strength * scaled(0.01, 1.0);
    CAPTURE(run, mass, damping, stiffness, friction);
    SimulatedDevice whole(point_mass(own * mass, own * damping, friction), {mass - own * mass, of_hand, stiffness});
    SimulatedDevice cut = whole;
    std::vector<Reference> axes(3, Reference{mass, damping, stiffness, friction});
    double scale = 0.0;
    for (int tick = 0; tick < 4; ++tick) {
      const Intention aim{reach * vector(), (often(0.2) ? 0.0 : reach * frequency) * vector()};
      const Eigen::Vector3d force = 2.0 * strength * vector();
      for (SimulatedDevice* device : {&whole, &cut}) {
        device->set_intention(aim);
        device->write(force);
      }
      const double turns = scaled(1e-3, 60.0), seconds = turns / (frequency * (1.0 + 2.0 * ratio));
      whole.advance(seconds);
      double rest = seconds;
      for (; often(0.8); rest *= 0.5) cut.advance(0.5 * rest);
      cut.advance(rest);
      scale += reach * (1.0 + turns) * (1.0 + turns);
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        Reference& expected = axes[static_cast<std::size_t>(axis)];
        const Real speed = aim.velocity[axis];
        expected.advance(force[axis] + of_hand * speed, aim.position[axis], speed, seconds);
        for (const SimulatedDevice* device : {&whole, &cut}) {
          REQUIRE(std::abs(device->true_position()[axis] - expected.x) < 1e-14 * scale);
          REQUIRE(std::abs(device->true_velocity()[axis] - expected.v) < 1e-14 * scale * frequency);
        }
      }
    }
  }
}

// ---- dry friction

TEST_CASE("a force below Coulomb friction never moves a mass at rest", "[devices]") {
  SimulatedDevice device(point_mass(0.045, 0.1, 0.26), spring(300.0, 3.0), {0.01, 0.02, 0.03});
  const double force = GENERATE(0.26, -0.26, 0.1, 5e-324, 0.0);
  device.write({force, -force, force});
  for (int i = 0; i < 1000; ++i) device.advance(1e-3);
  device.advance(1e4);
  CHECK(same_bits(device.true_position(), {0.01, 0.02, 0.03}));
  CHECK(device.true_velocity().isZero(0.0));
}

TEST_CASE("more stops than one call follows end at rest, with bounded work", "[devices]") {
  SimulatedDevice device = at_x(point_mass(0.045, 0.0, 1e-6), spring(1e6), 0.01);
  device.advance(1e6);
  CHECK(std::abs(x_of(device)) <= 0.01);
  CHECK(v_of(device) == 0.0);
  device.advance(1e-4);
  CHECK(v_of(device) != 0.0);
}

// ---- the sampled wall

namespace {

struct Wall {
  double period, friction, damping;
  int delay;
  GripImpedance grip;
  double critical_stiffness;
};

/// Whether an oscillation on a bilateral wall of this stiffness grows: compares its early and late amplitude over 20 s.
bool grows(const Wall& wall, double stiffness) {
  Capabilities profile = point_mass(0.045, wall.friction);
  profile.sample_delay = wall.delay;
  SimulatedDevice device = at_x(profile, wall.grip, 1e-3);
  const int ticks = static_cast<int>(20.0 / wall.period);
  double previous = 1e-3;
  double early = 0.0;
  double late = 0.0;
  for (int tick = 0; tick < ticks; ++tick) {
    const double x = device.read().position.x();
    device.write({-stiffness * x - wall.damping * (x - previous) / wall.period, 0.0, 0.0});
    previous = x;
    device.advance(wall.period);
    if (std::abs(x) > 10.0) return true;
    if (tick >= ticks / 4 && tick < ticks / 2) early = std::max(early, std::abs(x));
    if (tick >= ticks * 3 / 4) late = std::max(late, std::abs(x));
    if (tick == ticks / 2 && early < 1e-9) return false;
  }
  return late > early;
}

double critical_stiffness(const Wall& wall) {
  double stable = 10.0;
  double unstable = 1e6;
  while (unstable / stable > 1.0005) {
    const double middle = std::sqrt(stable * unstable);
    (grows(wall, middle) ? unstable : stable) = middle;
  }
  return std::sqrt(stable * unstable);
}

}  // namespace

TEST_CASE("a sampled wall becomes unstable at the theoretical stiffness", "[devices]") {
  const GripImpedance none{0.0, 0.0, 0.0};
  const Wall wall = GENERATE_COPY(
      Wall{10e-3, 0.5, 0.0, 0, none, 101.9}, Wall{1e-3, 0.05, 0.0, 0, none, 100.0},
      Wall{1e-3, 0.1, 0.0, 0, none, 200.1}, Wall{1e-3, 0.5, 0.0, 0, none, 1001.9},
      Wall{1e-3, 1.0, 0.0, 0, none, 2007.0}, Wall{1e-3, 2.0, 0.0, 0, none, 4030.0},
      Wall{50e-6, 0.5, 0.0, 0, none, 20001.9}, Wall{1e-3, 0.5, 0.0, 1, none, 334.4},
      Wall{1e-3, 0.5, 0.0, 2, none, 201.0}, Wall{1e-3, 0.5, 0.0, 5, none, 91.8}, Wall{1e-3, 0.1, 0.2, 0, none, 598.0},
      Wall{1e-3, 0.1, 0.5, 0, none, 1187.0}, Wall{1e-3, 0.1, 1.0, 0, none, 2153.0},
      Wall{1e-3, 0.1, 2.0, 0, none, 4019.0}, Wall{1e-3, 0.1, 5.0, 0, none, 9131.0},
      Wall{1e-3, 0.1, 10.0, 0, none, 16170.0}, Wall{1e-3, 0.1, 20.0, 0, none, 25606.0},
      Wall{1e-3, 0.1, 30.0, 0, none, 30139.0}, Wall{1e-3, 0.05, 0.0, 0, {0.05, 1.0, 100.0}, 2104.0},
      Wall{1e-3, 0.05, 0.0, 0, {0.1, 3.0, 300.0}, 6123.0}, Wall{1e-3, 0.05, 0.0, 0, {0.15, 5.0, 500.0}, 10146.0});
  CAPTURE(wall.period, wall.friction, wall.damping, wall.delay, wall.grip.stiffness);
  if (calligraphy_test::sanitized && wall.delay == 0) return;
  CHECK(critical_stiffness(wall) == Approx(wall.critical_stiffness).epsilon(0.002));
}

// ---- encoder and amplifier

TEST_CASE("a delayed device returns the state of that many ticks ago", "[devices]") {
  Capabilities profile = point_mass(0.045);
  profile.sample_delay = GENERATE(0, 1, 2, 5);
  SimulatedDevice device(profile);
  device.write({0.3, 0.0, 0.0});
  std::vector<Eigen::Vector3d> positions{device.true_position()};
  std::vector<Eigen::Vector3d> velocities{device.true_velocity()};
  for (int tick = 0; tick < 20; ++tick) {
    const int expected = std::max(0, tick - profile.sample_delay);
    const DeviceState state = device.read();
    REQUIRE(same_bits(state.position, positions[static_cast<std::size_t>(expected)]));
    REQUIRE(same_bits(state.velocity, velocities[static_cast<std::size_t>(expected)]));
    REQUIRE_FALSE(state.velocity_estimated);
    REQUIRE(state.time == Approx(expected * 1e-3));
    REQUIRE(state.buttons == (expected > 3 ? 1u : 0u));
    REQUIRE(state.status == DeviceStatus::ok);
    if (tick == 3) device.set_buttons(1);
    device.advance(1e-3);
    positions.push_back(device.true_position());
    velocities.push_back(device.true_velocity());
  }
}

TEST_CASE("a device that does not measure velocity estimates it from its quantised samples, one per advance",
          "[devices]") {
  Capabilities profile = device_profile("omni");
  profile.sample_delay = GENERATE(0, 3);
  profile.velocity_cutoff = GENERATE(50.0, 20.0);
  constexpr double period = 1e-3;
  SimulatedDevice device(profile, {0.1, 3.0, 300.0});
  device.set_intention({Eigen::Vector3d::Zero(), {0.2, -0.05, 0.0}});
  // Differences of the positions that are read, behind a first-order low-pass.
  const double share = 1.0 - std::exp(-2.0 * std::numbers::pi * profile.velocity_cutoff * period);
  Eigen::Vector3d last = device.read().position, expected = Eigen::Vector3d::Zero(), mean = Eigen::Vector3d::Zero();
  double ripple = 0.0;
  for (int tick = 0; tick < 1000; ++tick) {
    device.advance(period);
    const DeviceState state = device.read();
    expected += share * ((state.position - last) / period - expected);
    last = state.position;
    REQUIRE(state.velocity_estimated);
    REQUIRE((state.velocity - expected).norm() < 1e-12);
    if (tick < 500) continue;
    mean += state.velocity / 500.0;
    ripple = std::max(ripple, (state.velocity - device.true_velocity()).norm());
  }
  CHECK((mean - device.true_velocity()).norm() < 1e-3);
  CHECK(ripple > 0.1 * share * profile.encoder_step / period);  // it is not the true one
}

TEST_CASE("the encoder rounds positions to its nearest step and does not affect the motion", "[devices]") {
  Capabilities rough = point_mass(0.045);
  rough.encoder_step = 55e-6;
  SimulatedDevice device(rough, {0.0, 0.0, 0.0}, {26e-6, 28e-6, -28e-6});
  SimulatedDevice exact(point_mass(0.045), {0.0, 0.0, 0.0}, {26e-6, 28e-6, -28e-6});
  CHECK(device.read().position.isApprox(Eigen::Vector3d(0.0, 55e-6, -55e-6)));
  for (int tick = 0; tick < 200; ++tick) {
    for (SimulatedDevice* each : {&device, &exact}) {
      each->write({0.1, -0.07, 0.03});
      each->advance(1e-3);
    }
    const Eigen::Vector3d read = device.read().position;
    REQUIRE((read - device.true_position()).cwiseAbs().maxCoeff() <= 27.5e-6 * (1.0 + 1e-9));
    for (const double coordinate : read) {
      REQUIRE(std::abs(coordinate / 55e-6 - std::round(coordinate / 55e-6)) < 1e-9);
    }
    REQUIRE(same_bits(device.true_position(), exact.true_position()));
  }
}

TEST_CASE("a force above the peak is limited to it, with its direction preserved", "[devices]") {
  Capabilities omni = device_profile("omni");
  omni.force_step = 0.0;
  SimulatedDevice device(omni);
  const double size = GENERATE(3.3000001, 5.0, 1e10, 1e200, 1e308);
  const Eigen::Vector3d direction = Eigen::Vector3d(1.0, -0.9, 0.5).normalized();
  device.write(direction * size);
  CHECK(device.applied_force().norm() == Approx(3.3).epsilon(1e-14));
  CHECK((device.applied_force() / 3.3 - direction).norm() < 1e-14);
}

TEST_CASE("a force up to the peak is applied unchanged", "[devices]") {
  const Eigen::Vector3d force = GENERATE(Eigen::Vector3d(1.0, -2.0, 2.0), Eigen::Vector3d(0.0, 3.3, 0.0),
                                         Eigen::Vector3d(5e-324, 0.0, -1e-310), Eigen::Vector3d(0.0, 0.0, 0.0));
  Capabilities omni = device_profile("omni");
  omni.force_step = 0.0;
  SimulatedDevice device(omni);
  device.write(force);
  CHECK(same_bits(device.applied_force(), force));
  SimulatedDevice unlimited(device_profile("ideal"));
  unlimited.write(force * 1e300);
  CHECK(same_bits(unlimited.applied_force(), force * 1e300));
}

TEST_CASE("the DAC rounds each component of a force to its nearest step", "[devices]") {
  Capabilities coarse = point_mass(0.045);
  coarse.force_step = 0.25;
  SimulatedDevice device(coarse);
  device.write({0.30, -0.40, 0.12});
  CHECK(device.applied_force() == Eigen::Vector3d(0.25, -0.5, 0.0));
  CHECK(device.read().force == Eigen::Vector3d(0.25, -0.5, 0.0));
  device.advance(0.1);
  CHECK(device.true_velocity().isApprox(0.1 / 0.045 * Eigen::Vector3d(0.25, -0.5, 0.0)));
}

TEST_CASE("a rounded force never exceeds the peak, in whatever direction it is commanded", "[devices]") {
  for (const Capabilities& profile : device_profiles()) {
    if (profile.force_step == 0.0) continue;
    CAPTURE(profile.name);
    SimulatedDevice device(profile);
    Random random(5);
    const auto unit = [&] { return random.between(-1.0, 1.0); };
    double worst = 0.0;
    for (int i = 0; i < 5000; ++i) {
      const Eigen::Vector3d direction = Eigen::Vector3d(unit(), unit(), unit()).normalized();
      const double size = profile.peak_force * (i % 2 == 0 ? 1.0 + i : unit());
      const Eigen::Vector3d force = size * direction;
      device.write(force);
      REQUIRE(device.applied_force().norm() <= profile.peak_force);
      const Eigen::Vector3d wanted = std::abs(size) > profile.peak_force ? profile.peak_force * direction : force;
      worst = std::max(worst, (device.applied_force() - wanted).cwiseAbs().maxCoeff());
      if (size < 0.9 * profile.peak_force)
        REQUIRE((device.applied_force() - force).cwiseAbs().maxCoeff() <= 0.5001 * profile.force_step);
    }
    CHECK(worst <= 1.0001 * profile.force_step);
    device.write({0.0, profile.peak_force, 0.0});
    CHECK(device.applied_force().y() == Approx(profile.peak_force));
  }
}

TEST_CASE("a force that is not finite counts as zero", "[devices]") {
  const double bad = GENERATE(as<double>{}, not_a_number, infinity, -infinity);
  const std::string name = GENERATE("omni", "ideal");
  SimulatedDevice device(device_profile(name));
  device.write({1.0, 1.0, 1.0});
  device.write({1.0, bad, 1.0});
  CAPTURE(bad, name);
  CHECK(device.applied_force().isZero(0.0));
  CHECK(device.refused_forces() == 1);
}

TEST_CASE("a closed device has no force and reports disconnected", "[devices]") {
  SimulatedDevice device(point_mass(0.045, 0.5), {0.0, 0.0, 0.0}, {0.01, 0.0, 0.0});
  device.write({1.0, 0.0, 0.0});
  device.advance(1e-3);
  device.close();
  CHECK(device.applied_force().isZero(0.0));
  CHECK(device.read().status == DeviceStatus::disconnected);
  device.write({1.0, 0.0, 0.0});
  CHECK(device.applied_force().isZero(0.0));
  const double speed = v_of(device);
  device.advance(1e-3);
  CHECK(v_of(device) < speed);
  CHECK(device.read().status == DeviceStatus::disconnected);
  device.close();
  CHECK(device.read().status == DeviceStatus::disconnected);
}

// ---- faults on schedule

namespace {

/// A device dragged at 0.1 m/s along x, with its velocity measured, so that a sample tells when it was taken.
SimulatedDevice dragged(int delay = 0) {
  Capabilities profile = point_mass(0.045);
  profile.sample_delay = delay;
  SimulatedDevice device(profile, {1.0, 10.0, 1000.0}, {0.01, 0.0, 0.0});
  device.set_intention({Eigen::Vector3d::Zero(), {0.1, 0.0, 0.0}});
  return device;
}

constexpr double tick = 1e-3;  // [s]

}  // namespace

TEST_CASE("a stale fault repeats the last sample, and is over at its end", "[devices][faults]") {
  SimulatedDevice device = dragged();
  device.schedule({{.begin = 0.05, .duration = 0.01, .kind = SimulatedFaultKind::stale, .fault = DeviceFault::silent}});
  DeviceState before;
  int stale = 0;
  for (int i = 0; i < 100; ++i) {
    const DeviceState state = device.read();
    CAPTURE(i);
    if (i < 50 || i >= 60) {
      REQUIRE(state.status == DeviceStatus::ok);
      REQUIRE(state.position == device.true_position());
      before = state;
    } else {
      ++stale;
      REQUIRE(state.status == DeviceStatus::stale);
      REQUIRE(state.fault == DeviceFault::silent);
      REQUIRE(state.position == before.position);
      REQUIRE(state.time == before.time);
    }
    device.advance(tick);
  }
  CHECK(stale == 10);
}

TEST_CASE("late samples are as many ticks older as the fault says, on top of the device's delay", "[devices][faults]") {
  const int delay = GENERATE(0, 2), late = GENERATE(1, 7);
  const bool midway = GENERATE(false, true);  // scheduled while the device runs
  CAPTURE(delay, late, midway);
  SimulatedDevice device = dragged(delay);
  const std::vector<SimulatedFault> faults = {
      {.begin = 0.02, .duration = 0.02, .kind = SimulatedFaultKind::late, .ticks = late}};
  if (!midway) device.schedule(faults);
  std::vector<Eigen::Vector3d> positions;
  for (int i = 0; i < 60; ++i) {
    if (midway && i == 15) device.schedule(faults);
    positions.push_back(device.true_position());
    const int age = delay + (i >= 20 && i < 40 ? late : 0);
    const DeviceState state = device.read();
    CAPTURE(i);
    REQUIRE(state.status == DeviceStatus::ok);
    // A schedule midway repeats the oldest sample that the device had kept.
    const int taken = std::max(i - age, midway && i >= 20 ? 15 - delay : 0);
    REQUIRE(state.position == positions[static_cast<std::size_t>(taken)]);
    REQUIRE(state.time == Approx(taken * tick).margin(1e-12));
    device.advance(tick);
  }
}

TEST_CASE("garbage has no position although its status is ok", "[devices][faults]") {
  SimulatedDevice device = dragged();
  device.schedule({{.begin = 0.0, .duration = tick, .kind = SimulatedFaultKind::garbage}});
  const DeviceState state = device.read();
  CHECK(state.status == DeviceStatus::ok);
  CHECK(state.position.array().isNaN().all());
  CHECK(state.velocity.array().isNaN().all());
  device.advance(tick);
  CHECK(device.read().position == device.true_position());
}

TEST_CASE("a device is connected, and takes and has a force, exactly when its schedule of unplugs says",
          "[devices][faults]") {
  Random random(68);
  for (int run = 0; run < 200; ++run) {
    SimulatedDevice device = dragged();
    std::vector<SimulatedFault> unplugs;
    std::vector<bool> away(100);
    for (std::uint64_t count = random.index(4); count > 0; --count) {
      const int begin = static_cast<int>(random.index(90)) - 20, ticks = 1 + static_cast<int>(random.index(30));
      unplugs.push_back({.begin = begin * tick, .duration = ticks * tick, .kind = SimulatedFaultKind::unplugged});
      for (int i = std::max(begin, 0); i < begin + ticks; ++i) away[static_cast<std::size_t>(i)] = true;
    }
    const int scheduled = run % 2 == 0 ? 0 : static_cast<int>(random.index(50));
    Eigen::Vector3d force(1.0, 0.0, 0.0), last = device.true_position();
    device.write(force);
    for (int i = 0; i < 100; ++i) {
      CAPTURE(run, i, scheduled);
      if (i == scheduled) device.schedule(unplugs);
      const bool gone = i >= scheduled && away[static_cast<std::size_t>(i)];
      const DeviceState state = device.read();
      if (gone) force.setZero();
      if (!gone) last = device.true_position();
      REQUIRE(state.status == (gone ? DeviceStatus::disconnected : DeviceStatus::ok));
      REQUIRE(state.fault == (gone ? DeviceFault::unplugged : DeviceFault::none));
      REQUIRE(state.position == last);
      REQUIRE(state.force == force);
      if (random.next() < 0.5) {
        const Eigen::Vector3d next(random.between(-1.0, 1.0), 0.0, 0.0);
        device.write(next);
        if (!gone) force = next;
      }
      REQUIRE(device.applied_force() == force);
      device.advance(tick);
    }
  }
}

TEST_CASE("any status and fault can be reported on demand, and the first of several at once counts",
          "[devices][faults]") {
  SimulatedDevice device = dragged();
  device.schedule(
      {{.begin = 0.002, .duration = 0.002, .kind = SimulatedFaultKind::reported, .status = DeviceStatus::warm_motors},
       {.begin = 0.0,
        .duration = infinity,
        .kind = SimulatedFaultKind::reported,
        .status = DeviceStatus::fault,
        .fault = DeviceFault::overheated}});
  for (int i = 0; i < 100; ++i) {
    const DeviceState state = device.read();
    const bool warm = i == 2 || i == 3;
    CAPTURE(i);
    REQUIRE(state.status == (warm ? DeviceStatus::warm_motors : DeviceStatus::fault));
    REQUIRE(state.fault == (warm ? DeviceFault::none : DeviceFault::overheated));
    REQUIRE(state.position == device.true_position());
    device.advance(tick);
  }
  device.schedule({});
  CHECK(device.read().status == DeviceStatus::ok);
}

TEST_CASE("a schedule is refused by the number of its fault and the value", "[devices][faults]") {
  SimulatedDevice device = dragged();
  const auto complaint = [&device](const SimulatedFault& fault) -> std::string {
    try {
      device.schedule({{.duration = 1.0}, fault});
    } catch (const ValueError& error) {
      return error.what();
    }
    return {};
  };
  CHECK(complaint({.duration = 1.0}).empty());
  CHECK(complaint({.duration = infinity}).empty());
  CHECK(complaint({.begin = not_a_number, .duration = 1.0}) == "scheduled fault 1: begin = nan s, must be finite");
  CHECK(complaint({.duration = 0.0}) == "scheduled fault 1: duration = 0 s, must be above 0");
  CHECK(contains(complaint({.duration = not_a_number}), "duration = nan"));
  CHECK(contains(complaint({.duration = 1.0, .kind = SimulatedFaultKind::late, .ticks = 0}), "ticks = 0"));
  CHECK(contains(complaint({.duration = 1.0, .kind = SimulatedFaultKind::late, .ticks = 1001}), "ticks = 1001"));
}

TEST_CASE("a servo survives a schedule of every fault: the force falls, and returns after each", "[devices][faults]") {
  using Kind = SimulatedFaultKind;
  SimulatedDevice device(device_profile("desktop"), {0.15, 5.0, 500.0}, {0.0, 0.0, -0.002});
  device.schedule({{.begin = 1.0, .duration = 0.05, .kind = Kind::stale},
                   {.begin = 2.0, .duration = 0.05, .kind = Kind::garbage},
                   {.begin = 3.0, .duration = 0.05, .kind = Kind::unplugged},
                   {.begin = 4.0, .duration = 0.05, .kind = Kind::reported, .fault = DeviceFault::overheated}});
  bool finite = true;
  Servo servo(
      device,
      [&finite](const DeviceState& state) -> Eigen::Vector3d {
        finite = finite && state.position.allFinite() && state.velocity.allFinite() && state.force.allFinite();
        return {0.0, 0.0, std::max(0.0, -500.0 * state.position.z() - 2.0 * state.velocity.z())};
      },
      calligraphy_test::untimed());
  for (int i = 0; i < 5000; ++i) {
    servo.step(tick * i);
    const int after = i % 1000;  // of the last fault
    CAPTURE(i);
    if (i >= 1000 && after >= 15 && after < 50) REQUIRE(device.applied_force().isZero(0.0));
    if (after > 400) REQUIRE(device.applied_force().z() > 0.3);
    device.advance(tick);
  }
  CHECK(finite);
  const ServoStatistics statistics = servo.statistics();
  for (const DeviceFault fault :
       {DeviceFault::silent, DeviceFault::corrupted_frame, DeviceFault::unplugged, DeviceFault::overheated}) {
    CAPTURE(to_string(fault));
    CHECK(statistics.fault_count(fault) == 1);
  }
}

TEST_CASE("reading and writing on schedule do not allocate", "[devices][faults]") {
  SimulatedDevice device = dragged();
  std::vector<SimulatedFault> faults;
  for (int kind = 0; kind < 5; ++kind) {
    faults.push_back({.begin = 0.01 * kind, .duration = 0.005, .kind = static_cast<SimulatedFaultKind>(kind)});
  }
  device.schedule(faults);
  const std::size_t before = calligraphy_test::allocations();
  for (int i = 0; i < 60; ++i) {
    device.write(device.read().position);
    device.advance(tick);
  }
  const std::size_t after = calligraphy_test::allocations();
  CHECK(after == before);
}

// ---- hostile and extreme input

TEST_CASE("advancing by zero changes nothing, by an impossible time it is refused by its value", "[devices]") {
  SimulatedDevice device(device_profile("omni"), {0.1, 3.0, 300.0});
  device.set_intention({{0.01, 0.0, 0.0}, {1.0, 0.0, 0.0}});
  device.write({1.0, 2.0, 0.0});
  device.advance(1e-3);
  const Eigen::Vector3d position = device.true_position();
  const double time = device.time();
  for (const double seconds : {0.0, -0.0}) device.advance(seconds);
  for (const double seconds : {-1e-3, not_a_number, infinity, -infinity}) {
    CAPTURE(seconds);
    CHECK_THROWS_AS(device.advance(seconds), ValueError);
  }
  CHECK_THROWS_WITH(device.advance(-0.5), "advance: seconds = -0.5 s, must be finite and at least 0");
  CHECK(same_bits(device.true_position(), position));
  CHECK(device.time() == time);
}

TEST_CASE("an intention that is not finite is ignored", "[devices]") {
  const double bad = GENERATE(as<double>{}, not_a_number, infinity);
  SimulatedDevice device(point_mass(0.045), {0.1, 3.0, 300.0});
  device.set_intention({{0.01, 0.0, 0.0}, Eigen::Vector3d::Zero()});
  device.set_intention({{0.5, bad, 0.0}, Eigen::Vector3d::Zero()});
  device.set_intention({Eigen::Vector3d::Constant(0.5), {0.0, bad, 0.0}});
  device.advance(100.0);
  CHECK(device.true_position().isApprox(Eigen::Vector3d(0.01, 0.0, 0.0)));
}

TEST_CASE("a hand without an intention holds the start position", "[devices]") {
  SimulatedDevice device(point_mass(0.045), {0.1, 3.0, 300.0}, {0.03, -0.02, 0.01});
  for (int i = 0; i < 100; ++i) device.advance(1e-3);
  CHECK((device.true_position() - Eigen::Vector3d(0.03, -0.02, 0.01)).norm() < 1e-15);
}

TEST_CASE("motion stays finite at the limits of double", "[devices]") {
  const double seconds = GENERATE(5e-324, 1e-300, 1e-9, 1e-3, 10.0, 1e9, 1e300);
  const double force = GENERATE(0.0, 5e-324, 1.0, 1e308);
  const double stiffness = GENERATE(0.0, 5e-324, 1.0, 1e6, 1e300);
  const double coulomb = GENERATE(0.0, 5e-324, 0.26);
  CAPTURE(seconds, force, stiffness, coulomb);
  const double damping = GENERATE(0.0, 1e-310, 3.0, 1e300);
  SimulatedDevice device(point_mass(0.045, 0.0, coulomb), spring(stiffness, damping));
  device.set_intention({{0.01, 0.0, -0.01}, {0.1, 0.0, 0.0}});
  for (int i = 0; i < 3; ++i) {
    device.write({force, -force, 0.0});
    device.advance(seconds);
    REQUIRE(device.true_position().allFinite());
    REQUIRE(device.true_velocity().allFinite());
    REQUIRE(device.read().position.allFinite());
  }
}

TEST_CASE("a huge step ends where the forces balance", "[devices]") {
  SimulatedDevice device(point_mass(0.045), {0.1, 3.0, 300.0});
  device.write({0.6, 0.0, 0.0});
  device.set_intention({{0.01, -0.02, 0.0}, Eigen::Vector3d::Zero()});
  device.advance(1e6);
  CHECK((device.true_position() - Eigen::Vector3d(0.012, -0.02, 0.0)).norm() < 1e-15);
  CHECK(device.true_velocity().norm() < 1e-15);
}

TEST_CASE("the same calls give the same bits", "[devices]") {
  const auto run = [] {
    SimulatedDevice device(device_profile("desktop"), {0.1, 3.0, 300.0});
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int tick = 0; tick < 3000; ++tick) {
      device.set_intention({{0.01 * std::sin(0.01 * tick), 0.0, 0.005}, {0.1, 0.0, 0.0}});
      device.write(-500.0 * device.read().position);
      device.advance(tick % 7 == 0 ? 2.4e-3 : 1e-3);
      sum += device.read().position + device.true_velocity();
    }
    return sum;
  };
  CHECK(same_bits(run(), run()));
}

TEST_CASE("two devices at once are independent", "[devices]") {
  SimulatedDevice alone(point_mass(0.045, 0.1), {0.1, 3.0, 300.0});
  SimulatedDevice first(point_mass(0.045, 0.1), {0.1, 3.0, 300.0});
  SimulatedDevice second(device_profile("omni"));
  for (int tick = 0; tick < 100; ++tick) {
    alone.write({0.1, 0.0, 0.0});
    alone.advance(1e-3);
    first.write({0.1, 0.0, 0.0});
    second.write({0.0, 3.0, 0.0});
    first.advance(1e-3);
    second.advance(1e-3);
  }
  second.close();
  CHECK(same_bits(first.true_position(), alone.true_position()));
  CHECK(first.read().status == DeviceStatus::ok);
  CHECK(second.true_position().y() > 0.0);
}

TEST_CASE("reading, writing and advancing do not allocate", "[devices]") {
  Capabilities profile = device_profile("omni");
  profile.sample_delay = 3;
  SimulatedDevice device(profile, {0.1, 3.0, 300.0});
  const std::size_t control = calligraphy_test::allocations();
  ::operator delete(::operator new(1));  // checks the counter; a new-expression could be optimised away
  const std::size_t before = calligraphy_test::allocations();
  for (int tick = 0; tick < 1000; ++tick) {
    device.set_intention({{0.01 * std::sin(0.1 * tick), 0.0, 0.0}, {0.1, 0.0, 0.0}});
    device.write(-300.0 * device.read().position);
    device.advance(1e-3);
  }
  device.close();
  const std::size_t after = calligraphy_test::allocations();
  CHECK(before > control);
  CHECK(after == before);
}

// ---- profiles and validation

TEST_CASE("the built-in profiles have the values of their sources", "[devices]") {
  struct Row {
    const char* name;
    double peak, stiffness, continuous, resolution_mm;
    Eigen::Vector3d workspace_mm;
    double coulomb, mass, force_step_mn;
  };
  const Row row = GENERATE(Row{"omni", 3.3, 700.0, 0.88, 0.055, {160.0, 120.0, 70.0}, 0.26, 0.045, 1.61},
                           Row{"touch", 3.3, 400.0, 0.88, 0.055, {160.0, 120.0, 70.0}, 0.26, 0.045, 1.61},
                           Row{"desktop", 7.9, 1000.0, 1.75, 0.023, {160.0, 120.0, 120.0}, 0.06, 0.045, 3.86},
                           Row{"premium-1.5", 8.5, 800.0, 1.4, 0.03, {381.0, 267.0, 191.0}, 0.04, 0.075, 4.15});
  const Capabilities& profile = device_profile(row.name);
  CAPTURE(row.name);
  CHECK(profile.peak_force == row.peak);
  CHECK(profile.usable_stiffness == row.stiffness);
  CHECK(profile.continuous_force == row.continuous);
  CHECK(profile.encoder_step == Approx(row.resolution_mm * 1e-3));
  CHECK(profile.workspace.isApprox(row.workspace_mm * 1e-3));
  CHECK(profile.update_rate == 1000.0);
  CHECK(profile.coulomb_friction == row.coulomb);
  CHECK(profile.apparent_mass == row.mass);
  CHECK(1e3 * profile.force_step == Approx(row.force_step_mn).epsilon(0.003));  // 12 bits for both directions
  CHECK(profile.velocity == VelocitySource::estimated);
  CHECK(profile.velocity_cutoff == 50.0);
  CHECK(profile.viscous_friction >= 0.05);
  CHECK(profile.viscous_friction <= 0.5);
  CHECK(profile.sample_delay == 0);
}

TEST_CASE("the ideal profile adds nothing to a point mass", "[devices]") {
  const Capabilities& profile = device_profile("ideal");
  CHECK(profile.viscous_friction == 0.0);
  CHECK(profile.coulomb_friction == 0.0);
  CHECK(profile.encoder_step == 0.0);
  CHECK(profile.force_step == 0.0);
  CHECK(profile.velocity == VelocitySource::measured);
  CHECK(profile.sample_delay == 0);
  CHECK(profile.peak_force == infinity);
}

TEST_CASE("every built-in profile opens a device under its own name", "[devices]") {
  std::vector<std::string> names;
  for (const Capabilities& profile : device_profiles()) {
    CAPTURE(profile.name);
    CHECK(std::count(names.begin(), names.end(), profile.name) == 0);
    names.push_back(profile.name);
    SimulatedDevice device(device_profile(profile.name), {0.1, 3.0, 300.0});
    CHECK(device.capabilities().model == profile.model);
    CHECK(!profile.model.empty());
    CHECK(device.read().status == DeviceStatus::ok);
  }
  CHECK(names == std::vector<std::string>{"omni", "touch", "desktop", "premium-1.5", "ideal"});
}

TEST_CASE("an unknown profile is rejected with the available names", "[devices]") {
  std::string message;
  try {
    device_profile("omnibus");
  } catch (const ValueError& error) {
    message = error.what();
  }
  CHECK(contains(message, "omnibus"));
  CHECK(contains(message, "omni, touch, desktop, premium-1.5, ideal"));
}

TEST_CASE("an unphysical profile or grip is rejected with name and value", "[devices]") {
  const auto profile_error = [](auto&& change) {
    Capabilities profile = device_profile("omni");
    change(profile);
    return error_of(profile);
  };
  for (const double bad : {0.0, -0.5, infinity, not_a_number}) {
    CHECK(contains(profile_error([&](Capabilities& p) { p.apparent_mass = bad; }), "apparent mass"));
  }
  for (const double bad : {-0.5, infinity, not_a_number}) {
    CHECK(contains(profile_error([&](Capabilities& p) { p.viscous_friction = bad; }), "viscous friction"));
    CHECK(contains(profile_error([&](Capabilities& p) { p.coulomb_friction = bad; }), "Coulomb friction"));
    CHECK(contains(profile_error([&](Capabilities& p) { p.encoder_step = bad; }), "encoder step"));
    CHECK(contains(profile_error([&](Capabilities& p) { p.force_step = bad; }), "force step"));
    CHECK(contains(error_of(device_profile("omni"), {bad, 1.0, 1.0}), "mass of the grip"));
    CHECK(contains(error_of(device_profile("omni"), {1.0, bad, 1.0}), "damping of the grip"));
    CHECK(contains(error_of(device_profile("omni"), {1.0, 1.0, bad}), "stiffness of the grip"));
  }
  CHECK(
      contains(profile_error([](Capabilities& p) { p.force_step = 3.4; }), "force step = 3.4 N, must be at most the"));
  for (const double bad : {0.0, -1.0, infinity, not_a_number}) {
    CHECK(contains(profile_error([&](Capabilities& p) { p.velocity_cutoff = bad; }), "velocity cut-off"));
  }
  for (const double bad : {0.0, -1.0, not_a_number}) {
    CHECK(contains(profile_error([&](Capabilities& p) { p.peak_force = bad; }), "peak force"));
  }
  for (const double bad : {-1.0, not_a_number}) {
    CHECK(contains(profile_error([&](Capabilities& p) { p.workspace.y() = bad; }), "workspace = "));
    CHECK(contains(profile_error([&](Capabilities& p) { p.continuous_force = bad; }), "continuous force"));
    CHECK(contains(profile_error([&](Capabilities& p) { p.usable_stiffness = bad; }), "usable stiffness"));
    CHECK(contains(profile_error([&](Capabilities& p) { p.update_rate = bad; }), "update rate"));
  }
  CHECK(contains(profile_error([](Capabilities& p) { p.encoder_step = 0.055; }), "it is in metres"));
  CHECK(contains(profile_error([](Capabilities& p) { p.workspace.x() = 160.0; }), "it is in metres"));
  CHECK(contains(profile_error([](Capabilities& p) { p.apparent_mass = 45.0; }), "it is in kilograms"));
  CHECK(contains(profile_error([](Capabilities& p) { p.sample_delay = -1; }), "sample delay = -1"));
  CHECK(profile_error([](Capabilities& p) { p.usable_stiffness = infinity; }).empty());
  for (const int bad : {-1, 100'001}) {
    CHECK(contains(profile_error([&](Capabilities& p) { p.sample_delay = bad; }), "delay = " + std::to_string(bad)));
  }
  CHECK(contains(error_of(device_profile("omni"), {0.0, 0.0, 0.0}, {0.0, infinity, 0.0}), "position"));
  CHECK(contains(profile_error([](Capabilities& p) { p.apparent_mass = -0.5; }), "\"omni\": apparent mass = -0.5"));
}

TEST_CASE("the grip can be changed, and a rejected one leaves it unchanged", "[devices]") {
  SimulatedDevice device(point_mass(0.045));
  device.set_intention({{0.01, 0.0, 0.0}, Eigen::Vector3d::Zero()});
  device.advance(1.0);
  CHECK(x_of(device) == 0.0);
  device.set_grip({0.1, 3.0, 300.0});
  CHECK_THROWS_AS(device.set_grip({0.1, 3.0, -1.0}), ValueError);
  device.advance(100.0);
  CHECK(x_of(device) == Approx(0.01));
}

TEST_CASE("a device of unknown mass is valid but cannot be simulated", "[devices]") {
  Capabilities unknown = device_profile("omni");
  unknown.apparent_mass = 0.0;
  CHECK_NOTHROW(validate(unknown));
  CHECK(error_of(unknown) ==
        "device \"omni\": apparent mass = 0 kg, must be above 0: a device of unknown mass cannot be simulated");
}

TEST_CASE("invalid combinations of axes are rejected by name", "[devices]") {
  const auto axes_error = [](const DeviceAxes& sensed, const DeviceAxes& driven) -> std::string {
    Capabilities device = device_profile("omni");
    device.sensed = sensed;
    device.driven = driven;
    try {
      validate(device);
    } catch (const ValueError& error) {
      return error.what();
    }
    return "";
  };
  const DeviceAxes none{false, false, false, false}, translations, x{true, false, false, false},
      all{true, true, true, true};
  CHECK(axes_error(translations, translations).empty());
  CHECK(axes_error(all, translations).empty());
  CHECK(axes_error(translations, none).empty());  // a tablet
  CHECK(axes_error(x, x).empty());
  CHECK(axes_error(none, none) == "device \"omni\": no axis is sensed, at least one must be");
  CHECK(axes_error(translations, all) ==
        "device \"omni\": driven axes are x, y, z, rotations, sensed axes are x, y, z; driven but not sensed: "
        "rotations");
  CHECK(axes_error(x, translations) ==
        "device \"omni\": driven axes are x, y, z, sensed axes are x; driven but not sensed: y, z");
}

TEST_CASE("the simulation requires three translations, sensed and driven, and has no orientation", "[devices]") {
  Capabilities knob = device_profile("omni");
  knob.sensed = knob.driven = {true, false, false, false};
  CHECK(error_of(knob) ==
        "device \"omni\": sensed axes are x, driven axes are x; the simulation needs x, y and z to be sensed and "
        "driven");
  const DeviceState state = SimulatedDevice(device_profile("omni")).read();
  CHECK(state.stylus == StylusState());
}
