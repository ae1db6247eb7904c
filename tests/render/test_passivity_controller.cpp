// Passivity observer and controller: true energy, Colgate's bound, stable walls, a budget that is never exceeded.
#include "../catch.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <calligraphy/base/error.hpp>
#include <calligraphy/render/detail/force_limiter.hpp>
#include <calligraphy/render/passivity_controller.hpp>

#include "../allocation_counter.hpp"
#include "../hard_cases.hpp"
#include "../held_mass.hpp"
#include "../special_values.hpp"

using namespace calligraphy;
using calligraphy_test::HeldMass;
using calligraphy_test::Sequence;
using Eigen::Vector3d;

namespace {

using calligraphy_test::infinity;
using calligraphy_test::not_a_number;
const Vector3d lost(not_a_number, not_a_number, not_a_number);

Vector3d random_vector(Sequence& random, double largest) {
  const double x = random.between(-largest, largest), y = random.between(-largest, largest);
  return {x, y, random.between(-largest, largest)};
}

struct Press {
  double peak = 0.0;   ///< maximum force [N]
  double swing = 0.0;  ///< peak-to-peak motion over the last fifth [m]
};

/// A device of 45 g and 0.1 N s/m is pressed with 0.5 N onto a wall below 0, which it hits at 0.1 m/s, for 12 s. What
/// remains when the energy of sampling is removed, the damping of the device, has a time constant of 2 m / b = 0.9 s.
Press press(double stiffness, bool controlled, double saturation, int delay = 0, double period = 0.001) {
  constexpr double mass = 0.045, damping = 0.1, push = 0.5;
  PassivityOptions options;
  options.max_damping = controlled ? PassivityController::usable_damping(mass, period, delay) : 0.0;
  options.delay = delay;
  PassivityController passivity(options, period);
  HeldMass pen(mass, damping, period);
  pen.speed = -0.1;
  std::vector<double> places(static_cast<std::size_t>(delay) + 1, 0.0);
  const int ticks = static_cast<int>(12.0 / period);
  double lowest = infinity, highest = -infinity;
  Press result;
  for (int i = 0; i < ticks; ++i) {
    std::rotate(places.begin(), places.end() - 1, places.end());
    places[0] = pen.place;
    const double sample = places.back();
    Vector3d force = passivity.next({0.0, 0.0, sample}, {0.0, 0.0, std::max(0.0, -stiffness * sample)});
    force.z() = std::clamp(force.z(), -saturation, saturation);
    passivity.sent(force);
    result.peak = std::max(result.peak, std::abs(force.z()));
    pen.advance(force.z() - push);
    if (i < ticks - ticks / 5) continue;
    lowest = std::min(lowest, pen.place);
    highest = std::max(highest, pen.place);
  }
  result.swing = highest - lowest;
  return result;
}

using Pen = std::function<Vector3d(double time)>;
using Field = std::function<Vector3d(double time, const Vector3d& velocity, const Vector3d& last_force)>;

struct Setting {
  double rate = 1000.0;
  int delay = 0;
  double budget = 0.01;
  double jerk = infinity;      ///< of the limiter that follows [N/s^2]
  bool limited = true;         ///< a force limiter follows
  double share_of_lost = 0.0;  ///< fraction of the samples
};

constexpr double force_rate = 100.0, peak = 3.3;

/// Maximum energy that the force has delivered at any tick to a pen on a prescribed path, relative to the budget: true
/// work.
double max_given(const Setting& setting, const Pen& pen, const Field& field, double seconds) {
  const double period = 1.0 / setting.rate;
  PassivityOptions options;
  options.energy_budget = setting.budget;
  options.delay = setting.delay;
  if (setting.limited) options.force_rate = force_rate;
  PassivityController passivity(options, period);
  ForceLimiter limiter{force_rate * period, 4.0 * force_rate * period, peak, setting.limited,
                       setting.jerk * period * period};
  Sequence random(3);
  Vector3d force(0, 0, 0), place = pen(0.0);
  double given = 0.0, most = 0.0;
  const auto sample = [&](int tick) { return pen(std::max(0, tick) * period); };
  for (int i = 0; i < static_cast<int>(seconds * setting.rate); ++i) {
    const bool is_lost = random.next() < setting.share_of_lost;
    const Vector3d position = sample(i - setting.delay);
    const Vector3d velocity = (position - sample(i - setting.delay - 1)) / period;
    if (is_lost) {
      passivity.next(lost, Vector3d(0, 0, 0));
      force = limiter.release(force);
    } else {
      const Vector3d wanted = passivity.next(position, field(i * period, velocity, force));
      force = limiter.next(force, wanted, passivity.max_force());
    }
    passivity.sent(force);
    const Vector3d next = pen((i + 1) * period);
    given += force.dot(next - place);
    most = std::max(most, given);
    place = next;
  }
  return most / setting.budget;
}

Pen straight(double speed) {
  return [speed](double time) { return Vector3d(0.6 * speed * time, 0.8 * speed * time, 0.0); };
}

/// Back and forth, up to `speed`, with accelerations up to `acceleration`.
Pen to_and_fro(double speed, double acceleration) {
  const double frequency = acceleration / speed;
  return [=](double time) {
    const double way = speed / frequency * std::sin(frequency * time);
    return Vector3d(0.6 * way, 0.8 * way, 0.0);
  };
}

/// In a circle, so that the direction of motion turns constantly.
Pen round(double speed, double acceleration) {
  const double frequency = acceleration / speed, radius = speed / frequency;
  return [=](double time) {
    return Vector3d(radius * std::cos(frequency * time), radius * std::sin(frequency * time), 0.0);
  };
}

Vector3d unit(const Vector3d& velocity) {
  const double speed = velocity.norm();
  return speed > 0.0 ? Vector3d(velocity / speed) : Vector3d(0, 0, 0);
}

/// Fields that deliver energy as fast as they can.
const std::vector<std::pair<const char*, Field>> hostile_fields = {
    {"along the motion",
     [](double, const Vector3d& velocity, const Vector3d&) -> Vector3d { return 10.0 * unit(velocity); }},
    {"along the motion and to and fro along the normal",
     [](double time, const Vector3d& velocity, const Vector3d&) -> Vector3d {
       const double normal = std::fmod(time, 0.02) < 0.01 ? 2.0 : -2.0;
       return 10.0 * (unit(velocity) + Vector3d(0, 0, normal));
     }},
    {"along the motion and swinging about it",
     [](double time, const Vector3d& velocity, const Vector3d&) -> Vector3d {
       const Vector3d along = unit(velocity), across(-along.y(), along.x(), 0.0);
       return 10.0 * (along + (std::fmod(time, 0.01) < 0.005 ? 1.5 : -1.5) * across);
     }},
    {"turning away from the last force, so that it hardly falls",
     [](double, const Vector3d& velocity, const Vector3d& last) -> Vector3d {
       const Vector3d along = unit(velocity);
       return 10.0 * along + 3.0 * Vector3d(-last.y(), last.x(), 0.0);
     }},
    {"on and off", [](double time, const Vector3d& velocity, const Vector3d&) -> Vector3d {
       return (std::fmod(time, 0.06) < 0.03 ? 10.0 : -1.0) * unit(velocity);
     }}};

#ifdef __SANITIZE_ADDRESS__
constexpr double hostile_seconds = 0.5;
#else
constexpr double hostile_seconds = 2.0;
#endif

}  // namespace

TEST_CASE("the observed energy is the true work of the held force", "[render]") {
  // Random forces and steps, so that nothing but F(n) . (x(n + 1) - x(n)) can add up to it.
  for (const int delay : {0, 1, 2, 5, PassivityController::max_delay}) {
    PassivityOptions options;
    options.delay = delay;
    PassivityController passivity(options, 0.001);
    Sequence random(41);
    std::vector<Vector3d> places = {random_vector(random, 0.1)};
    std::vector<double> work = {0.0};  // done until each tick
    double max_error = 0.0;
    for (int i = 0; i < 5000; ++i) {
      const std::size_t seen = static_cast<std::size_t>(std::max(0, i - delay));
      passivity.next(places[seen], random_vector(random, 3.0));
      max_error = std::max(max_error, std::abs(passivity.energy_given() - work[seen]));
      const Vector3d force = random_vector(random, 3.0);
      passivity.sent(force);
      places.push_back(places.back() + random_vector(random, 1e-3));
      work.push_back(work.back() + force.dot(places[places.size() - 1] - places[places.size() - 2]));
    }
    INFO("delay " << delay);
    CHECK(std::abs(work.back()) > 1e-3);
    CHECK(max_error < 1e-13 * 5000);
  }
}

TEST_CASE("a pen that runs into a spring is damped by K T / 2, Colgate's bound", "[render]") {
  for (const double stiffness : {500.0, 5000.0}) {
    for (const double speed : {0.01, 0.1}) {
      for (const double period : {0.0001, 0.001, 0.01}) {
        for (const int axis : {0, 2}) {
          PassivityOptions options;
          options.max_damping = 1e6;
          PassivityController passivity(options, period);
          Vector3d place(0, 0, 0);
          passivity.next(place, Vector3d(0, 0, 0));
          passivity.sent(Vector3d(0, 0, 0));
          place[axis] = speed * period;
          passivity.next(place, -stiffness * place);
          Vector3d expected(0, 0, 0);
          expected[axis] = -0.5 * stiffness * period * speed;
          CHECK((passivity.damping() - expected).norm() < 1e-9 * expected.norm());
        }
      }
    }
  }
}

TEST_CASE("damping stays below its maximum, in plane and along the normal separately", "[render]") {
  PassivityOptions options;
  options.max_damping = 0.2;
  PassivityController passivity(options, 0.001);
  passivity.next({0, 0, 0}, {0, 0, 0});
  passivity.sent({0, 0, 0});
  const Vector3d force = passivity.next({3e-4, 4e-4, -2e-4}, {-30.0, -40.0, 20.0});
  CHECK(passivity.damping().isApprox(Vector3d(-0.2 * 0.3, -0.2 * 0.4, 0.2 * 0.2)));
  CHECK(force.isApprox(Vector3d(-30.0, -40.0, 20.0) + passivity.damping()));
}

TEST_CASE("with control a pen comes to rest on a wall 10 to 50 times stiffer than is passive, below the peak",
          "[render]") {
  // b = 0.1 N s/m and T = 1 ms: critical is 200 N/m.
  for (const double stiffness : {2001.0, 5000.0, 10'000.0}) {
    const Press with = press(stiffness, true, 7.9), without = press(stiffness, false, 7.9);
    INFO(stiffness << " N/m: peak " << with.peak << " N, peak-to-peak " << with.swing << " m, without "
                   << without.swing);
    CHECK(with.swing < 1e-6);
    CHECK(with.peak < 7.9);
    CHECK(without.swing > 1e-4);
  }
}

TEST_CASE("with control a pen comes to rest on a wall that a delayed sample makes unstable", "[render]") {
  for (const int delay : {1, 2}) {
    const Press with = press(1000.0, true, 7.9, delay), without = press(1000.0, false, 7.9, delay);
    INFO("delay " << delay << ": peak-to-peak " << with.swing << " m, without " << without.swing);
    CHECK(with.swing < 1e-6);
    CHECK(with.peak < 7.9);
    CHECK(without.swing > 1e-4);
  }
}

TEST_CASE("dissipated energy is no credit to vibrate on", "[render]") {
  PassivityOptions options;
  options.max_damping = 1e6;
  PassivityController passivity(options, 0.001);
  double place = 0.0;
  for (int i = 0; i < 1000; ++i) {  // 0.1 m against 1 N that the field does not request
    passivity.next({place, 0, 0}, {0, 0, 0});
    passivity.sent({i < 999 ? -1.0 : 0.0, 0, 0});
    place += 1e-4;
  }
  CHECK(passivity.energy_given() < -0.09);
  place -= 1e-4;  // where the force last dissipated; the spring below begins here
  passivity.next({place, 0, 0}, {0, 0, 0});
  passivity.sent({0, 0, 0});
  passivity.next({place + 1e-4, 0, 0}, {-1000.0 * 1e-4, 0, 0});
  CHECK(passivity.damping().x() == Approx(-0.5 * 1000.0 * 0.001 * 0.1));
}

TEST_CASE("no field, pen speed, rate or delay extracts more than the budget from controller and limiter", "[render]") {
  for (const double rate : {100.0, 1000.0, 20'000.0}) {
    for (const int delay : {0, 1, 2}) {
      for (const double jerk : {infinity, 1e5, 2e4}) {
        Setting setting{rate, delay, 0.01, jerk};
        const double seconds = rate > 5000.0 ? 0.25 * hostile_seconds : hostile_seconds;
        for (const auto& [name, field] : hostile_fields) {
          // With |F| / rate = 33 ms and two delayed samples of 10 ms each, 0.25 m/s are 4 m/s^2.
          for (const Pen& pen : {straight(0.1), straight(1.0), to_and_fro(0.5, 4.0), round(0.3, 4.0)}) {
            INFO(name << ", " << rate << " Hz, delay " << delay << ", jerk " << jerk);
            CHECK(max_given(setting, pen, field, seconds) <= 1.0 + 1e-9);
          }
        }
      }
    }
  }
}

TEST_CASE("the budget holds whatever its size, and is used", "[render]") {
  for (const double budget : {0.0, 1e-9, 1e-3, 0.1}) {
    for (const auto& [name, field] : hostile_fields) {
      const Setting setting{1000.0, 0, std::max(budget, 1e-300), 1e5};
      const double share = max_given(setting, straight(1.0), field, hostile_seconds);
      INFO(name << ", " << budget << " J");
      CHECK(share <= 1.0 + 1e-9);
      if (budget >= 1e-3) CHECK(share > 0.9);
    }
  }
}

TEST_CASE("the budget holds without a limiter, where a force is removed at once", "[render]") {
  for (const auto& [name, field] : hostile_fields) {
    for (const double rate : {100.0, 1000.0, 20'000.0}) {
      const Setting setting{rate, 0, 0.01, infinity, false};
      INFO(name << ", " << rate << " Hz");
      CHECK(max_given(setting, straight(1.0), field, 0.25 * hostile_seconds) <= 1.0 + 1e-9);
    }
  }
}

TEST_CASE("lost samples are charged as if the pen continued along the force", "[render]") {
  for (const double share : {0.01, 0.1, 0.5, 0.9}) {
    for (const double speed : {0.1, 1.0}) {
      for (const int delay : {0, 2}) {
        Setting setting{1000.0, delay, 0.01, 1e5};
        setting.share_of_lost = share;
        for (const auto& [name, field] : hostile_fields) {
          INFO(name << ", " << share << " lost, " << speed << " m/s, delay " << delay);
          CHECK(max_given(setting, straight(speed), field, hostile_seconds) <= 1.0 + 1e-9);
        }
      }
    }
  }
}

TEST_CASE("a pen that accelerates beyond the assumption gains no more than the force and that speed allow",
          "[render]") {
  // From rest to 2 m/s at once, while a force along it is as large as the budget allows.
  const double budget = 0.005, delay = 0.2;
  const Pen thrown = [=](double time) { return Vector3d(1e-3 * time + 2.0 * std::max(0.0, time - delay), 0, 0); };
  const Field along = [](double, const Vector3d&, const Vector3d&) { return Vector3d(10.0, 0, 0); };
  const Setting setting{1000.0, 0, budget, infinity};
  // F^2 v / (2 rate) with v = 0.251 m/s is all of the budget; u = 2 - 0.251 m/s.
  const double force = std::sqrt(2.0 * force_rate * budget / 0.251);
  const double beyond = force * (2.0 - 0.251) * (force / force_rate + 0.001);
  const double given = budget * max_given(setting, thrown, along, 0.5);
  CHECK(given > budget);
  CHECK(given <= budget + beyond);
}

TEST_CASE("energy that the hand returns is added to the budget, up to its size", "[render]") {
  PassivityOptions options;
  options.energy_budget = 0.01;
  PassivityController passivity(options, 0.001);
  double place = 0.0;
  const auto move = [&](double way, double force) {
    passivity.next({place, 0, 0}, {force, 0, 0});
    passivity.sent({force, 0, 0});
    place += way;
    passivity.next({place, 0, 0}, {force, 0, 0});
    passivity.sent({0, 0, 0});
  };
  CHECK(passivity.energy_remaining() == 0.01);
  move(0.004, 1.0);
  CHECK(passivity.energy_remaining() == Approx(0.006));
  move(-0.003, 1.0);
  CHECK(passivity.energy_remaining() == Approx(0.009));
  move(-0.009, 1.0);
  CHECK(passivity.energy_remaining() == 0.01);
  CHECK(passivity.energy_given() == Approx(0.004 - 0.003 - 0.009));
}

TEST_CASE("without a budget or damping the desired force is unchanged", "[render]") {
  PassivityController passivity(PassivityOptions{}, 0.001);
  Sequence random(9);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d wanted = random_vector(random, 10.0);
    CHECK(passivity.next(random_vector(random, 0.01), wanted) == wanted);
    passivity.sent(random_vector(random, 3.0));
  }
  CHECK(std::isinf(passivity.max_force()));
}

TEST_CASE("a lost sample injects no damping and leaves every value finite", "[render]") {
  PassivityOptions options;
  options.max_damping = 10.0;
  options.energy_budget = 0.01;
  PassivityController passivity(options, 0.001);
  Sequence random(10);
  bool finite = true;
  for (int i = 0; i < 2000; ++i) {
    const bool is_lost = i % 5 < 2;
    Vector3d position = random_vector(random, 0.001);
    if (is_lost) position[i % 3] = i % 2 ? not_a_number : infinity;
    const Vector3d force = passivity.next(position, random_vector(random, 3.0));
    finite = finite && force.allFinite() && std::isfinite(passivity.energy_given()) &&
             std::isfinite(passivity.energy_remaining());
    if (is_lost) CHECK(passivity.damping() == Vector3d(0, 0, 0));
    passivity.sent(force);
  }
  CHECK(finite);
}

TEST_CASE("samples lost before the first good one are not charged", "[render]") {
  PassivityOptions options;
  options.energy_budget = 0.01;
  PassivityController passivity(options, 0.001);
  for (int i = 0; i < 10; ++i) {
    passivity.next(lost, {0, 0, 0});
    passivity.sent({0, 0, 0});
  }
  passivity.next({0.1, 0.2, 0.3}, {0, 0, 0});
  CHECK(passivity.energy_given() == 0.0);
  CHECK(passivity.energy_remaining() == 0.01);
}

TEST_CASE("a restarted passivity controller behaves like a new one", "[render]") {
  PassivityOptions options;
  options.max_damping = 10.0;
  options.energy_budget = 0.01;
  options.delay = 3;
  PassivityController used(options, 0.001);
  Sequence random(11);
  for (int i = 0; i < 100; ++i) {
    used.next(i % 7 ? random_vector(random, 0.01) : lost, random_vector(random, 3.0));
    used.sent(random_vector(random, 3.0));
  }
  used.next(lost, {0, 0, 0});
  used.sent({1.0, 0, 0});
  used.restart();
  PassivityController fresh(options, 0.001);
  for (int i = 0; i < 100; ++i) {
    const Vector3d position = random_vector(random, 0.01), wanted = random_vector(random, 3.0);
    const Vector3d force = fresh.next(position, wanted);
    CHECK(used.next(position, wanted) == force);
    CHECK(used.energy_remaining() == fresh.energy_remaining());
    fresh.sent(force);
    used.sent(force);
  }
}

TEST_CASE("an option of the passivity controller out of range is named with its value", "[render]") {
  const auto complaint = [](const PassivityOptions& options, double period) -> std::string {
    try {
      PassivityController(options, period);
    } catch (const ValueError& error) {
      return error.what();
    }
    return "";
  };
  const auto names = [&](const PassivityOptions& options, double period, const std::string& text) {
    const std::string found = complaint(options, period);
    INFO(found << " should have " << text);
    CHECK(found.find(text) != std::string::npos);
  };
  CHECK(complaint({}, 0.001).empty());
  for (const auto& [value, text] : {std::pair{-0.5, "-0.5"}, {not_a_number, "nan"}, {-infinity, "-inf"}}) {
    names({.max_damping = value}, 0.001, std::string("max_damping = ") + text);
    names({.energy_budget = value}, 0.001, std::string("energy_budget = ") + text);
    names({.force_rate = value}, 0.001, std::string("force_rate = ") + text);
    names({}, value, std::string("period = ") + text);
  }
  names({.max_damping = infinity}, 0.001, "max_damping = inf");
  names({.force_rate = 0.0}, 0.001, "force_rate = 0");
  names({}, 0.0, "period = 0");
  names({}, infinity, "period = inf");
  names({.delay = -1}, 0.001, "delay = -1");
  names({.delay = 16}, 0.001, "delay = 16");
}

TEST_CASE("the passivity controller does not allocate", "[render]") {
  PassivityOptions options;
  options.max_damping = 10.0;
  options.energy_budget = 0.01;
  options.delay = 2;
  PassivityController passivity(options, 0.001);
  Sequence random(12);
  const std::size_t before = calligraphy_test::allocations();
  for (int i = 0; i < 10'000; ++i) {
    passivity.sent(passivity.next(i % 11 ? random_vector(random, 0.01) : lost, random_vector(random, 3.0)));
  }
  passivity.restart();
  CHECK(calligraphy_test::allocations() == before);
}
